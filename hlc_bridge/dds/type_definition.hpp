#pragma once

#include <map>
#include <string>

namespace hlc::dds {

/// The files of the folder idl by name. They are a part of the program (embed.cmake).
[[nodiscard]] const std::map<std::string, std::string>& idl_files();

/// The IDL of a message type ("VehicleState", "hlc::TrafficMessage") with all types that it uses,
/// each before its first use, without preprocessor lines. @pre the file of its name defines it
[[nodiscard]] std::string type_definition(const std::string& type);

}  // namespace hlc::dds
