#include "hlc_bridge/view/foxglove_schemas.hpp"

namespace hlc::view {
namespace {

/// An object whose members are all numbers.
Json numbers_schema(const std::vector<const char*>& names) {
  Members members;
  for (const char* name : names) members.emplace_back(name, plain_schema("number"));
  return object_schema(members);
}

/// A time or a duration.
Json time_schema() {
  return object_schema({{"sec", plain_schema("integer")}, {"nsec", plain_schema("integer")}});
}

/// A primitive has pose and color, and what else is given.
Json primitives_schema(const Members& others) {
  Members members{{"pose", object_schema({{"position", numbers_schema({"x", "y", "z"})},
                                          {"orientation", numbers_schema({"x", "y", "z", "w"})}})},
                  {"color", numbers_schema({"r", "g", "b", "a"})}};
  members.insert(members.end(), others.begin(), others.end());
  return array_schema(object_schema(members));
}

Json entity_schema() {
  const Json text = plain_schema("string");
  const Json flag = plain_schema("boolean");
  const Json number = plain_schema("number");
  const Json whole = plain_schema("integer");
  const Json point = numbers_schema({"x", "y", "z"});
  Members members{
      {"timestamp", time_schema()},
      {"frame_id", text},
      {"id", text},
      {"lifetime", time_schema()},
      {"frame_locked", flag},
      {"metadata", array_schema(object_schema({{"key", text}, {"value", text}}))},
      {"cubes", primitives_schema({{"size", point}})},
      {"lines", primitives_schema({{"type", whole},
                                   {"thickness", number},
                                   {"scale_invariant", flag},
                                   {"points", array_schema(point)},
                                   {"colors", array_schema(numbers_schema({"r", "g", "b", "a"}))},
                                   {"indices", array_schema(whole)}})},
      {"texts", primitives_schema({{"billboard", flag},
                                   {"font_size", number},
                                   {"scale_invariant", flag},
                                   {"text", text}})}};
  for (const char* never : {"arrows", "spheres", "cylinders", "triangles", "models"}) {
    members.emplace_back(never, primitives_schema({}));
  }
  return object_schema(members);
}

}  // namespace

Json plain_schema(const char* name) { return Json::object({{"type", name}}); }

Json object_schema(const Members& members) {
  Json properties = Json::object();
  for (const auto& [name, schema] : members) properties[name] = schema;
  return Json::object({{"type", "object"}, {"properties", std::move(properties)}});
}

Json array_schema(Json items) {
  return Json::object({{"type", "array"}, {"items", std::move(items)}});
}

std::string schema_text(const char* title, const Members& members) {
  Json schema = object_schema(members);
  schema["title"] = title;
  return text_of(schema);
}

std::string scene_schema() {
  const Json deletion = object_schema({{"timestamp", time_schema()},
                                       {"type", plain_schema("integer")},
                                       {"id", plain_schema("string")}});
  return schema_text(kSceneUpdate, {{"deletions", array_schema(deletion)},
                                    {"entities", array_schema(entity_schema())}});
}

std::string log_schema() {
  return schema_text(kLog, {{"timestamp", time_schema()},
                            {"level", plain_schema("integer")},
                            {"message", plain_schema("string")},
                            {"name", plain_schema("string")},
                            {"file", plain_schema("string")},
                            {"line", plain_schema("integer")}});
}

}  // namespace hlc::view
