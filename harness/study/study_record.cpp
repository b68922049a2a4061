#include "study/study_record.hpp"

#include <fstream>

#include "cell/machine.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

void write_study_record(const std::filesystem::path& folder, const StudyFile& study, const std::string& command) {
  const std::filesystem::path file = folder / "study.json", draft = folder / "study.json.part";
  const Json asked = Json::parse(study.json.dump());
  {
    std::ifstream in(file);
    const Json known = Json::parse(in, nullptr, false);
    if (known.is_object() && known.value("study", Json()) == asked) return;
  }
  Json machine = describe_machine();
  const Json started = machine["date"];
  const Json record{
      {"name", study.name}, {"command", command}, {"study", asked}, {"started", started}, {"machine", machine}};
  std::ofstream out(draft);
  out << record.dump(2) << "\n";
  out.close();
  std::error_code failure;
  if (out) std::filesystem::rename(draft, file, failure);
  if (!out || failure) throw UsageError("cannot write " + file.string() + "; name a folder that may be written to");
}

}  // namespace plumb::harness
