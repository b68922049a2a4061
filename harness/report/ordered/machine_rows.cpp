#include "report/ordered/machine_rows.hpp"

#include <algorithm>

#include "report/ordered/against.hpp"

namespace plumb::harness {

std::vector<MachineRows> rows_by_machine(const std::vector<Json>& lines) {
  std::vector<MachineRows> groups;
  for (const Json& line : lines) {
    ResultRow row = parse_row(line, 0);
    std::string machine = hardware_of(row.machine);
    if (machine.empty()) machine = "a machine that is not named";
    auto group = std::find_if(groups.begin(), groups.end(), [&](const MachineRows& g) { return g.name == machine; });
    if (group == groups.end()) group = groups.insert(groups.end(), {std::move(machine), {}});
    group->rows.push_back(std::move(row));
  }
  if (groups.empty()) groups.emplace_back();
  std::size_t index = 0;
  for (MachineRows& group : groups) {
    for (ResultRow& row : group.rows) row.index = index++;
  }
  return groups;
}

}  // namespace plumb::harness
