# shakebed_build_info: files/build_info.hpp, one small source rewritten when the commit changes.
execute_process(
  COMMAND "${CMAKE_CXX_COMPILER}" -march=${SHAKEBED_MACHINE} -Q --help=target
  OUTPUT_VARIABLE target_help ERROR_QUIET)
set(machine "${SHAKEBED_MACHINE}")
if(SHAKEBED_MACHINE STREQUAL "native" AND target_help MATCHES "-march=[ \t]+([^ \t\n]+)")
  string(APPEND machine " (${CMAKE_MATCH_1})")
endif()

string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
list(JOIN SHAKEBED_CODE_FLAGS " " code_flags)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} ${code_flags}" compiler_flags)

set(build_info_source "${CMAKE_BINARY_DIR}/generated/build_info.cpp")
add_custom_target(write_build_info
  COMMAND "${CMAKE_COMMAND}"
    -D "SOURCE_DIR=${CMAKE_SOURCE_DIR}"
    -D "TEMPLATE=${CMAKE_SOURCE_DIR}/files/build_info.cpp.in"
    -D "OUTPUT=${build_info_source}"
    -D "VERSION=${PROJECT_VERSION}"
    -D "COMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    -D "COMPILER_FLAGS=${compiler_flags}"
    -D "MACHINE=${machine}"
    -D "PRESET=${SHAKEBED_PRESET}"
    -P "${CMAKE_SOURCE_DIR}/cmake/WriteBuildInfo.cmake"
  BYPRODUCTS "${build_info_source}"
  COMMENT "Noting the git revision" VERBATIM)

add_library(shakebed_build_info STATIC "${build_info_source}")
add_dependencies(shakebed_build_info write_build_info)
target_link_libraries(shakebed_build_info PRIVATE shakebed_flags)
target_include_directories(shakebed_build_info PUBLIC "${CMAKE_SOURCE_DIR}")
