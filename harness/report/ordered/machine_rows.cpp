#include "report/ordered/machine_rows.hpp"

#include <algorithm>

#include "report/ordered/against.hpp"

namespace plumb::harness {

std::vector<MachineRows> rows_by_machine(const std::vector<Row>& rows) {
  std::vector<MachineRows> groups;
  for (const Row& row : rows) {
    std::string machine = hardware_of(row.origin.machine);
    if (machine.empty()) machine = "a machine that is not named";
    auto group = std::find_if(groups.begin(), groups.end(), [&](const MachineRows& g) { return g.name == machine; });
    if (group == groups.end()) group = groups.insert(groups.end(), {std::move(machine), {}});
    group->rows.push_back(row);
  }
  if (groups.empty()) groups.emplace_back();
  std::size_t index = 0;
  for (MachineRows& group : groups) {
    for (Row& row : group.rows) row.origin.index = index++;
  }
  return groups;
}

}  // namespace plumb::harness
