// The list of measures of joints, and what they share.
#include "measure/joints/joints.hpp"

#include <cmath>

namespace plumb::harness {

void place_rods(Scene& scene, const std::vector<std::size_t>& rods, double length, const referee::Vec3& start,
                const referee::Vec3& along, const std::vector<double>& angles) {
  referee::Vec3 end = start;
  for (std::size_t i = 0; i < rods.size(); ++i) {
    const referee::Quat turn(Eigen::AngleAxisd(angles[i], referee::Vec3::UnitZ()));
    const referee::Vec3 half = length / 2 * (turn * along);
    PlumbPose& pose = scene.bodies[rods[i]].desc.pose;
    pose.position = referee::plain(end + half);
    pose.orientation = {turn.x(), turn.y(), turn.z(), turn.w()};
    end += 2 * half;
  }
}

double turn_about_z(const Scene& scene, std::span<const PoseRow> poses, std::size_t body) {
  const referee::Quat start = referee::quat(scene.bodies[body].desc.pose.orientation);
  const referee::Vec3 axis = referee::quat(poses[body].orientation) * start.conjugate() * referee::Vec3::UnitX();
  return std::atan2(axis.y(), axis.x());
}

std::span<const MeasureEntry> joint_measures() {
  using enum ArgumentType;
  static constexpr MeasureArgument chain_args[] = {{"tip", body}, {"top", joint}, {"motion", word}};
  static constexpr MeasureArgument mode_args[] = {{"rods", bodies},
                                                  {"tip", body, may_be_left_out},
                                                  {"length", number},
                                                  {"tip_mass", number},
                                                  {"amplitude", number}};
  static constexpr MeasureArgument catenary_args[] = {
      {"planks", bodies}, {"length", number}, {"span", number}, {"end", joint}};
  static constexpr MeasureArgument slider_args[] = {
      {"mechanism", word}, {"slope", number}, {"crank_length", number}, {"rod_length", number}};
  static constexpr MeasureArgument parallelogram_args[] = {{"crank", body}, {"length", number}, {"amplitude", number}};
  static constexpr MeasureArgument motor_args[] = {
      {"disc", body}, {"torque", number}, {"target", number}, {"load", number}};
  static constexpr MeasureArgument stop_args[] = {{"rod", body}, {"length", number}, {"stop", number}};
  static constexpr MeasureArgument toppling_args[] = {{"plank", body}, {"length", number}, {"start", number}};
  static constexpr MeasureArgument spring_args[] = {
      {"bob", body}, {"rest", number}, {"frequency", number}, {"damping_ratio", number}, {"task", word}};
  static constexpr MeasureArgument cantilever_args[] = {{"cubes", bodies}, {"root", joint}, {"length", number}};
  static constexpr MeasureArgument four_bar_args[] = {
      {"crank", body}, {"rocker", body}, {"lengths", numbers}, {"start", number}, {"speed", number}};
  static constexpr MeasureArgument universal_args[] = {{"first", body}, {"second", body}, {"bend", number}};
  static constexpr MeasureArgument net_args[] = {{"length", number}, {"stretched", number}};
  static constexpr MeasureEntry entries[] = {
      {"heavy_chain", "joint gaps of a chain with a heavy tip, and its tension at rest", chain_args,
       measure_heavy_chain},
      {"chain_mode", "period of a hanging chain's slowest mode", mode_args, measure_chain_mode},
      {"net", "gaps of a net of joints, or of a chain that starts stretched", net_args, measure_net},
      {"catenary", "shape and end force of a chain at rest between two points", catenary_args, measure_catenary},
      {"slider", "a sled on a slope, or the piston of a slider-crank", slider_args, measure_slider},
      {"parallelogram", "period and gaps of a closed linkage that swings", parallelogram_args, measure_parallelogram},
      {"motor", "speed and angle of a disc on a motor", motor_args, measure_motor},
      {"limit_stop", "a rod that falls on the limit of its hinge", stop_args, measure_limit_stop},
      {"toppling", "time and speed of a plank that topples about its foot", toppling_args, measure_toppling},
      {"spring", "ringing or sag of a body on a damped spring from the origin", spring_args, measure_spring},
      {"cantilever", "sag and root moment of a beam of welded cubes", cantilever_args, measure_cantilever},
      {"four_bar", "rocker's angle of a four-bar linkage by that of its driven crank", four_bar_args, measure_four_bar},
      {"universal", "second shaft of a universal joint by the first", universal_args, measure_universal},
      {"free_figure", "momentum of a jointed figure in free space", {}, measure_free_figure},
  };
  return entries;
}

}  // namespace plumb::harness
