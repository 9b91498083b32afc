#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

/// The allowed dependencies between the folders (README, "Folders").
namespace hlc::test {

/// Folder -> folders that it may use, beside itself. A folder stands for those below it, and a file
/// for itself alone.
using Arrows = std::map<std::string, std::set<std::string>>;

[[nodiscard]] const Arrows& arrows();

/// The folder of `arrows` that a path from the root lies in; nothing for foreign paths.
[[nodiscard]] std::optional<std::string> room_of(const std::string& path);

/// Whether files of the room may include this one. @pre room is a key of `arrows`
[[nodiscard]] bool may_use(const std::string& room, const std::string& file);

/// Whether the room's library may be linked with one of `other`: it may include some file there.
/// @pre both are keys of `arrows`
[[nodiscard]] bool may_link(const std::string& room, const std::string& other);

/// Rooms that use each other in a circle, "a -> b -> a"; empty if there are none. Single files that
/// a room may use, and no more of their folder, count as that folder.
[[nodiscard]] std::string circle_of(const Arrows& arrows);

}  // namespace hlc::test
