#include "planner/apps/output_files.hpp"

#include <unistd.h>

#include <stdexcept>

#include "planner/common/yaml_text.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

bool are_same(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  // Absolute first: for a path without any existing folder, weakly_canonical leaves `x` relative
  // and makes `./x` absolute.
  const fs::path full_a = fs::weakly_canonical(fs::absolute(a), error);
  if (error) return false;
  const fs::path full_b = fs::weakly_canonical(fs::absolute(b), error);
  return !error && full_a == full_b;
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Description of a good file instead of this one; empty if it is good.
std::string objection_to(const fs::path& file) {
  if (file.empty()) return "the name of a file";
  std::error_code error;
  const fs::path folder = folder_of(file);
  if (!fs::is_directory(folder, error)) return "a file in an existing folder";
  // The link itself is checked: /dev/stdout may lead to a regular file.
  const fs::file_status status = fs::symlink_status(file, error);
  if (!file.has_filename() ||
      !(status.type() == fs::file_type::not_found || status.type() == fs::file_type::regular)) {
    return "a new or a regular file";
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) return "a file in a writable folder";
  return "";
}

}  // namespace

CLI::Option* declare_output(CLI::App& app, OutputFile& output, const std::string& help) {
  return app
      .add_option_function<std::string>(
          output.flag, [&output](const std::string& file) { output.file = file; }, help)
      ->type_name("FILE");
}

void check_output_files(const std::vector<OutputFile>& outputs,
                        const std::vector<fs::path>& inputs) {
  std::vector<const OutputFile*> before;
  for (const OutputFile& output : outputs) {
    if (!output.file) continue;
    const auto fail = [&output](const std::string& allowed) {
      throw std::invalid_argument(output.flag + " = " + one_line(output.file->string()) +
                                  ", must be " + allowed);
    };
    const std::string objection = objection_to(*output.file);
    if (!objection.empty()) fail(objection);
    for (const fs::path& input : inputs) {
      if (are_same(*output.file, input)) fail("a file other than the input");
    }
    for (const OutputFile* other : before) {
      if (are_same(*output.file, *other->file)) fail("a file other than that of " + other->flag);
    }
    before.push_back(&output);
  }
}

}  // namespace hlc::apps
