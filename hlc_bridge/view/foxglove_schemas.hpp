#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/view/page_json.hpp"

/// JSON schemas of messages for Foxglove and Lichtblick. These refuse a topic whose schema has an
/// object without `properties`, at any depth; what a schema does not name they do not show.
namespace hlc::view {

inline constexpr const char* kSceneUpdate = "foxglove.SceneUpdate";
inline constexpr const char* kLog = "foxglove.Log";

/// Names and schemas.
using Members = std::vector<std::pair<const char*, Json>>;

/// @param name  "number", "integer", "string" or "boolean"
[[nodiscard]] Json plain_schema(const char* name);
[[nodiscard]] Json object_schema(const Members& members);
[[nodiscard]] Json array_schema(Json items);
/// Of messages of the type `title`.
[[nodiscard]] std::string schema_text(const char* title, const Members& members);

[[nodiscard]] std::string scene_schema();
[[nodiscard]] std::string log_schema();

}  // namespace hlc::view
