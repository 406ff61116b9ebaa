# The settings that `accuracy` chooses from, as a source: the simulator reads no data files, and a
# table that changes makes another program.
function(shakebed_accuracy_table csv source)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${csv}")
  file(STRINGS "${csv}" lines)
  set(SHAKEBED_STEPS_ROWS)
  set(SHAKEBED_STIFFNESS_ROWS)
  foreach(line IN LISTS lines)
    if(line MATCHES "^dt closed,([^,]+),([^,]+),([^,]+),")
      string(APPEND SHAKEBED_STEPS_ROWS
        "    {${CMAKE_MATCH_1}, ${CMAKE_MATCH_2} / 100.0, ${CMAKE_MATCH_3}},\n")
    elseif(line MATCHES "^k_n,([^,]+),([^,]+),([^,]+),")
      string(APPEND SHAKEBED_STIFFNESS_ROWS
        "    {${CMAKE_MATCH_1}, ${CMAKE_MATCH_2} / 100.0, ${CMAKE_MATCH_3}},\n")
    endif()
  endforeach()
  if(NOT SHAKEBED_STEPS_ROWS OR NOT SHAKEBED_STIFFNESS_ROWS)
    message(FATAL_ERROR "${csv}: expected rows of the axes `dt closed` and `k_n`; "
      "make it again with the target trade-accuracy-table")
  endif()
  configure_file("${PROJECT_SOURCE_DIR}/simulator/scene/accuracy_table.cpp.in" "${source}" @ONLY)
endfunction()
