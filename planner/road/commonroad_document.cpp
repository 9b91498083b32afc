#include "planner/road/commonroad_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace hlc::road {

using tinyxml2::XMLElement;

CommonRoadDocument::CommonRoadDocument(std::string_view xml, std::string name)
    : name_(std::move(name)) {
  if (document_.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
    fail(document_.ErrorLineNum(), fmt::format("not well-formed XML ({})", document_.ErrorName()));
  }
  const XMLElement* root = document_.RootElement();
  if (root == nullptr || std::strcmp(root->Name(), "commonRoad") != 0) {
    fail(root == nullptr ? 1 : root->GetLineNum(), "root element must be <commonRoad>");
  }
  const std::string_view version = attribute(*root, "commonRoadVersion");
  if (version != "2020a" && version != "2018b") {
    fail(*root,
         fmt::format("commonRoadVersion is {}, must be \"2020a\" or \"2018b\"", quoted(version)));
  }
}

void CommonRoadDocument::fail(int line, const std::string& what) const {
  throw std::runtime_error(fmt::format("{}:{}: {}", name_, line, what));
}

void CommonRoadDocument::fail(const XMLElement& element, const std::string& what) const {
  fail(element.GetLineNum(), what);
}

void CommonRoadDocument::for_each_child(const XMLElement& element, const char* child_name,
                                        const std::function<void(const XMLElement&)>& visit) {
  for (const XMLElement* one = element.FirstChildElement(child_name); one != nullptr;
       one = one->NextSiblingElement(child_name)) {
    visit(*one);
  }
}

std::string CommonRoadDocument::quoted(std::string_view value) {
  constexpr std::size_t kMaxLength = 40;
  std::string text(value.substr(0, kMaxLength));
  for (char& c : text) {
    c = c < ' ' ? ' ' : c;
  }
  return '"' + text + (value.size() > kMaxLength ? "...\"" : "\"");
}

std::string_view CommonRoadDocument::attribute(const XMLElement& element,
                                               const char* attribute_name) const {
  const char* value = element.Attribute(attribute_name);
  if (value == nullptr) {
    fail(element, fmt::format("<{}> needs the attribute {}", element.Name(), attribute_name));
  }
  return value;
}

int CommonRoadDocument::id_attribute(const XMLElement& element, const char* attribute_name) const {
  const std::string_view text = attribute(element, attribute_name);
  int id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error != std::errc{} || end != text.data() + text.size() || id < 1) {
    fail(element, fmt::format("<{}> {} is {}, must be a whole number from 1 to 2147483647",
                              element.Name(), attribute_name, quoted(text)));
  }
  return id;
}

const XMLElement& CommonRoadDocument::child(const XMLElement& element,
                                            const char* child_name) const {
  const XMLElement* found = element.FirstChildElement(child_name);
  if (found == nullptr) {
    fail(element, fmt::format("<{}> needs a <{}>", element.Name(), child_name));
  }
  return *found;
}

double CommonRoadDocument::number(const XMLElement& element, const char* child_name,
                                  const char* unit) const {
  const XMLElement& found = child(element, child_name);
  std::string_view text = found.GetText() == nullptr ? "" : found.GetText();
  constexpr const char* kBlank = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  text = text.substr(0, text.find_last_not_of(kBlank) + 1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    fail(found,
         fmt::format("<{}> is {}, must be a finite number [{}]", child_name, quoted(text), unit));
  }
  return value;
}

}  // namespace hlc::road
