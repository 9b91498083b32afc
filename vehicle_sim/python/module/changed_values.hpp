#pragma once

#include <filesystem>
#include <string>

#include "planner/common/node.hpp"
#include "vehicle_sim/python/module/bindings.hpp"

namespace hlc::python {

/// A YAML file with other values for some of its keys: a dict in a dict changes a map key by key,
/// any other value (str, bool, int, float, list, dict for an absent key) replaces what is there,
/// and None removes the key. The lines in messages are the file's; a key that it does not have is
/// reported at the line of the key before it.
/// @throws std::invalid_argument as Node::read_yaml, or naming the key if its value is of another
/// type
[[nodiscard]] Node read_with_changes(const std::filesystem::path& file, const py::dict& changes);

/// The text of such a file for the folder of a run (record::keep_configuration): a map, lab or
/// automaton is named by the place of its copy there.
/// @pre read_with_changes throws nothing
[[nodiscard]] std::string text_with_changes(const std::filesystem::path& file,
                                            const py::dict& changes);

}  // namespace hlc::python
