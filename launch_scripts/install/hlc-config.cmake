# find_package(hlc 0.1 CONFIG): hlc::planner, the planner with the reader of scenarios and the rollout in memory; its
# headers are included as planner/<room>/<header>.hpp (tests/install/example is a project that plans). hlc_DATA_DIR has the
# scenarios, automata, maps and problems.
get_filename_component(hlc_DATA_DIR "${CMAKE_CURRENT_LIST_DIR}/../../../share/hlc" ABSOLUTE)
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(Eigen3 3.4)
find_dependency(Boost 1.74)
find_dependency(NLopt 2.7)
find_dependency(OpenSSL)
find_dependency(fmt)
find_dependency(nlohmann_json)
find_dependency(yaml-cpp)
include(${CMAKE_CURRENT_LIST_DIR}/hlc-targets.cmake)
