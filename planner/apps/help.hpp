#pragma once

#include <string>
#include <vector>

#include "planner/apps/cli.hpp"

namespace hlc::apps {

/// What a program's --help ends with.
struct HelpEnd {
  std::vector<std::string> examples;  ///< complete commands, at least two
  std::string exit_codes{"0 success, 2 invalid input or an output that cannot be written"};
  std::string notes{};  ///< before the examples; empty: none
};

void declare_help_end(CLI::App& app, const HelpEnd& end);

/// Help as wide as the terminal; of the other flags that a flag needs or excludes, those that a
/// reader can remember.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace hlc::apps
