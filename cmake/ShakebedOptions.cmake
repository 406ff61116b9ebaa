# Flags every target of ours shares. Targets of ours link shakebed_flags (PRIVATE).
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

set(SHAKEBED_MACHINE "native" CACHE STRING
  "-march of the build: native (this machine) or x86-64-v3 (portable; makes the shipped data)")
option(SHAKEBED_WERROR "Warnings are errors on our targets" ON)
set(SHAKEBED_SANITIZE "" CACHE STRING "Sanitizers, for instance address,undefined or thread")
set(SHAKEBED_PRESET "none" CACHE STRING "The preset's name, for the provenance of results")

# Flags that can change numbers; build_info reports them with every result. The same binary must
# give the same bytes on every run: no contraction across statements, and no fast-math anywhere.
# (What is switched off beside it, errno and traps, changes no number.)
set(SHAKEBED_CODE_FLAGS -march=${SHAKEBED_MACHINE} -ffp-contract=off -fno-math-errno
  -fno-trapping-math)
if(SHAKEBED_SANITIZE)
  list(APPEND SHAKEBED_CODE_FLAGS -fsanitize=${SHAKEBED_SANITIZE} -fno-omit-frame-pointer)
endif()

add_library(shakebed_flags INTERFACE)
target_include_directories(shakebed_flags INTERFACE "${CMAKE_SOURCE_DIR}")
target_compile_options(shakebed_flags INTERFACE
  ${SHAKEBED_CODE_FLAGS}
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<BOOL:${SHAKEBED_WERROR}>:-Werror>
  # g++ 12 takes `"text" + std::string` for overlapping copies at -O3 (GCC bug 105651).
  -Wno-restrict
  # g++ 12 warns inside its own AVX-512 intrinsics (GCC bug 105593) and of instrumented variables.
  -Wno-uninitialized
  -Wno-maybe-uninitialized)
if(SHAKEBED_SANITIZE)
  target_link_options(shakebed_flags INTERFACE -fsanitize=${SHAKEBED_SANITIZE})
endif()
