# cmake -DNEW=file -DTARGET=file -P ReplaceIfChanged.cmake
# Moves NEW over TARGET only when the contents differ, so that what depends on TARGET stays fresh.
execute_process(COMMAND "${CMAKE_COMMAND}" -E compare_files "${NEW}" "${TARGET}"
  RESULT_VARIABLE different OUTPUT_QUIET ERROR_QUIET)
if(different)
  file(RENAME "${NEW}" "${TARGET}")
else()
  file(REMOVE "${NEW}")
endif()
