#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/apps/cli.hpp"

namespace hlc::apps {

/// A file that a program writes, by its flag.
struct OutputFile {
  std::string flag;                           ///< "--out"
  std::optional<std::filesystem::path> file;  ///< absent: the flag was not given
};

/// Declares the flag of `output`, whose file is set when the command line is read, also to an empty
/// text.
/// @pre `output` outlives the reading
CLI::Option* declare_output(CLI::App& app, OutputFile& output, const std::string& help);

/// To be called before the computation. Each given file must lie in an existing, writable folder,
/// be new or a regular file (no link to one), and differ from each input and each other output,
/// under any name (hard links, `./x`).
/// @throws std::invalid_argument with one line "flag = file, must be ..."
void check_output_files(const std::vector<OutputFile>& outputs,
                        const std::vector<std::filesystem::path>& inputs = {});

}  // namespace hlc::apps
