// Writes the samples of commonroad_samples.hpp: write_commonroad_samples DIR

#include <iostream>

#include "planner/common/text_file.hpp"
#include "tests/support/commonroad_samples.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_commonroad_samples DIR\n";
    return 2;
  }
  for (const hlc::test::CommonRoadSample& sample : hlc::test::commonroad_samples()) {
    hlc::write_file(std::filesystem::path(argv[1]) / (sample.name + ".xml"), sample.xml);
    std::cout << sample.name << '\n';
  }
}
