#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/apps/cli.hpp"

namespace hlc {

/// A file that a program writes, by its flag.
struct OutputFile {
  std::string flag;                           ///< "--out"
  std::optional<std::filesystem::path> file;  ///< absent: the flag was not given
};

/// Declares the flag of `output`, whose file is set when the command line is read, also to an empty
/// text.
/// @pre `output` outlives the reading
CLI::Option* declare_output(CLI::App& app, OutputFile& output, const std::string& help);

/// To be called before anything is computed. Each file that is given must lie in a folder that
/// exists and may be written to, be new or a regular file (no link to one), and be another one
/// than each input and each other output, under whatever name (hard links, `./x`).
/// @throws std::invalid_argument with one line "flag = file, allowed ..."
void check_output_files(const std::vector<OutputFile>& outputs,
                        const std::vector<std::filesystem::path>& inputs = {});

}  // namespace hlc
