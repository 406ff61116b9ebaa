# The settings that `accuracy` chooses from, and the laws of bias that warnings state, as a source: the
# simulator reads no data files, and a table that changes makes another program.
function(shakebed_accuracy_table accuracy laws source)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${accuracy}" "${laws}")
  file(STRINGS "${accuracy}" lines)
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
  file(STRINGS "${laws}" lines)
  set(SHAKEBED_LAW_ROWS)
  set(number "([^,]+)")
  foreach(line IN LISTS lines)
    # scene, axis, dimension, rough, W, layers, restitution, amplitude, coefficient, its error
    if(line MATCHES "^${number},dt (closed|stepped),${number},([01]),${number},${number},${number},[^,]+,${number},${number},")
      set(closed false)
      if(CMAKE_MATCH_2 STREQUAL "closed")
        set(closed true)
      endif()
      set(row "\"${CMAKE_MATCH_1}\", ${closed}, ${CMAKE_MATCH_3}, ${CMAKE_MATCH_4} == 1")
      string(APPEND row ", ${CMAKE_MATCH_5}, ${CMAKE_MATCH_6}, ${CMAKE_MATCH_7}")
      string(APPEND SHAKEBED_LAW_ROWS
        "    {${row}, ${CMAKE_MATCH_8}, ${CMAKE_MATCH_9}},\n")
    endif()
  endforeach()
  if(NOT SHAKEBED_STEPS_ROWS OR NOT SHAKEBED_STIFFNESS_ROWS OR NOT SHAKEBED_LAW_ROWS)
    message(FATAL_ERROR "${accuracy} and ${laws}: expected rows of the axes `dt closed`, "
      "`dt stepped` and `k_n`; make them again with the target trade-accuracy-table")
  endif()
  configure_file("${PROJECT_SOURCE_DIR}/simulator/scene/accuracy_table.cpp.in" "${source}" @ONLY)
endfunction()
