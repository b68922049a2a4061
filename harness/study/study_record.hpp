// study.json beside the results: what was asked, by which line, on which machine, when.
#pragma once

#include <filesystem>
#include <string>

#include "study/study_file.hpp"

namespace plumb::harness {

/// Writes {"name", "command", "study", "started", "machine"}. A folder whose record is of the same study keeps it: the
/// study goes on. Throws UsageError when it cannot be written.
void write_study_record(const std::filesystem::path& folder, const StudyFile& study, const std::string& command);

}  // namespace plumb::harness
