# Fast DDS 3 as installed by install.sh in ${HLC_FAST_DDS_3}, for the target hlc_fast_dds. The wheels' own package files
# name places of the machine that built them.
set(fast_dds_3_library ${HLC_FAST_DDS_3}/library)
file(GLOB fast_dds_3_bundled ${fast_dds_3_library}/lib/python3*/site-packages/ros_fastdds.libs) # what the wheel brings along
set(FASTDDSGEN ${HLC_FAST_DDS_3}/generator/fastddsgen)
foreach(file ${fast_dds_3_library}/include/fastdds/config.hpp ${fast_dds_3_library}/lib/libfastdds.so ${fast_dds_3_library}/lib/libfastcdr.so ${FASTDDSGEN})
  if(NOT EXISTS ${file} OR NOT fast_dds_3_bundled)
    message(FATAL_ERROR "HLC_FAST_DDS_3 = ${HLC_FAST_DDS_3}, must be a folder of hlc_bridge/dds/fast_dds_3/install.sh: incomplete, ${file}")
  endif()
endforeach()
target_compile_definitions(hlc_fast_dds INTERFACE HLC_FAST_DDS=3)
target_include_directories(hlc_fast_dds SYSTEM INTERFACE ${fast_dds_3_library}/include)
target_link_libraries(hlc_fast_dds INTERFACE ${fast_dds_3_library}/lib/libfastdds.so ${fast_dds_3_library}/lib/libfastcdr.so)
# For a library's own dependencies the loader follows this kind of path only.
target_link_options(hlc_fast_dds INTERFACE LINKER:--disable-new-dtags LINKER:-rpath,${fast_dds_3_bundled})
