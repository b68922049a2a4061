// The list of measures of stacks.
#include "measure/stacking/stacking.hpp"

namespace plumb::harness {

std::span<const MeasureEntry> stacking_measures() {
  using enum ArgumentType;
  static constexpr MeasureArgument boxes_args[] = {{"boxes", bodies}};
  static constexpr MeasureArgument pyramid_args[] = {{"boxes", bodies}, {"base", number}};
  static constexpr MeasureArgument ratio_args[] = {{"lower", body}, {"upper", body}};
  static constexpr MeasureArgument overhang_args[] = {{"blocks", bodies}, {"share", number}};
  static constexpr MeasureArgument spheres_args[] = {
      {"top", body}, {"base", bodies}, {"ground", body}, {"friction", number}};
  static constexpr MeasureArgument lattice_args[] = {{"spheres", bodies}};
  static constexpr MeasureArgument arch_args[] = {
      {"stones", bodies}, {"radius", number}, {"thickness", number}, {"friction", number}};
  static constexpr MeasureArgument catto_args[] = {
      {"stones", bodies}, {"boxes", number}, {"wide", number}, {"friction", number}};
  static constexpr MeasureArgument cards_args[] = {
      {"cards", bodies}, {"lean", number}, {"friction", number}, {"length", number}};
  static constexpr MeasureArgument masonry_args[] = {{"blocks", bodies}, {"height", number}, {"reach", number}};
  static constexpr MeasureArgument big_args[] = {{"big", body}, {"small", bodies}};
  static constexpr MeasureArgument taken_args[] = {
      {"balls", bodies}, {"load", body}, {"time", number}, {"away", number}};
  static constexpr MeasureEntry entries[] = {
      {"tower", "sink, drift, depth and rest of a tower, from the ground up", boxes_args, measure_tower},
      {"pyramid", "boxes in place, symmetry and depth of a planar pyramid", pyramid_args, measure_pyramid},
      {"mass_ratio", "depth, rest and forces of one box on another", ratio_args, measure_mass_ratio},
      {"overhang", "whether the harmonic stack stands", overhang_args, measure_overhang},
      {"four_spheres", "whether three spheres carry a fourth, and by which forces", spheres_args, measure_four_spheres},
      {"voussoir_arch", "whether an arch of wedges stands", arch_args, measure_voussoir_arch},
      {"catto_arch", "whether Catto's arch stands under its load", catto_args, measure_catto_arch},
      {"cards", "whether a leaning card stands, or for how long a house of cards", cards_args, measure_cards},
      {"masonry", "how long loose blocks keep their places, and how they creep", masonry_args, measure_masonry},
      {"big_on_small", "depth, tilt and loads of a big cube on small ones", big_args, measure_big_on_small},
      {"taken_load", "how a stack jumps when its load is taken", taken_args, measure_taken_load},
      {"sphere_lattice", "overlaps of many spheres that fall and scatter", lattice_args, measure_sphere_lattice},
  };
  return entries;
}

}  // namespace plumb::harness
