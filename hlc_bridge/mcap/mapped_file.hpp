#pragma once

#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace hlc::mcap {

/// A file in memory, as far as it is looked at.
class MappedFile {
 public:
  /// @throws std::runtime_error naming the file if it cannot be read
  explicit MappedFile(const std::filesystem::path& file) try
      : mapping_(file.c_str(), boost::interprocess::read_only),
        region_(mapping_, boost::interprocess::read_only) {
  } catch (const boost::interprocess::interprocess_exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  [[nodiscard]] std::string_view bytes() const {
    return {static_cast<const char*>(region_.get_address()), region_.get_size()};
  }

 private:
  boost::interprocess::file_mapping mapping_;
  boost::interprocess::mapped_region region_;
};

}  // namespace hlc::mcap
