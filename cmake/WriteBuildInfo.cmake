# cmake -D SOURCE_DIR=.. -D TEMPLATE=.. -D OUTPUT=.. -D VERSION=.. (...) -P WriteBuildInfo.cmake
# Run at every build; configure_file leaves an unchanged file alone, so that a build without a new
# commit compiles and links nothing.
set(GIT_REVISION unknown)
find_program(GIT git)
if(GIT AND EXISTS "${SOURCE_DIR}/.git")
  execute_process(
    COMMAND "${GIT}" -c "safe.directory=${SOURCE_DIR}" -C "${SOURCE_DIR}" rev-parse --short=12 HEAD
    OUTPUT_VARIABLE revision RESULT_VARIABLE failed
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed)
    set(GIT_REVISION "${revision}")
    # Code alone: a pipeline that rewrites data/ does not make another program.
    # GIT_OPTIONAL_LOCKS=0: a build must not hold git's index lock while someone commits.
    execute_process(
      COMMAND "${CMAKE_COMMAND}" -E env GIT_OPTIONAL_LOCKS=0
        "${GIT}" -c "safe.directory=${SOURCE_DIR}" -C "${SOURCE_DIR}" diff --quiet HEAD --
        files simulator sweeps fitting figures cli cmake CMakeLists.txt
      RESULT_VARIABLE modified OUTPUT_QUIET ERROR_QUIET)
    if(NOT modified EQUAL 0)
      string(APPEND GIT_REVISION "-modified")
    endif()
  endif()
endif()
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
