# The experiments as chains of files, each link declared once:
#
#   add_sweep(id FILE sweep.yaml [SHIPPED averages.csv] [PROFILES [SHIPPED_PROFILES profiles.csv]])
#     or with SNAPSHOTS [SHIPPED_SNAPSHOTS snapshots.csv], or with SERIES or NETWORKS
#   add_scene(id FILE scene.yaml)
#   add_table(id FILE table.csv)
#   add_fit(id FILE fit.yaml SWEEP sweep-id [USES files...])
#   add_figure(id SPEC figure.yaml NEEDS sweep- and fit-ids)
#
# Every chain exists over tables of up to four origins, each with files under results/<origin>/:
#   quick    targets sweep-<id>, fit-<id>, <figure id>           beds at the quick profile
#   standard the same names with -standard, of sweeps with STANDARD   beds between both in size
#   paper    the same names with -paper                          beds at the paper profile
#   shipped  the same names with -shipped, and `refit` for all   averages under data/, no bed
#
# A sweep target always runs: `shakebed sweep run` asks the cache (file times must not decide about
# physics), and its table is replaced only when its content changed. Fits and figures are ordinary
# file rules behind that table, so a changed fit never touches a bed.
#
# A figure's specification knows the tables by the ids of its NEEDS: a sweep's table under its id (its
# height profiles under <id>.profiles, its snapshots under <id>.snapshots), a fit's under <id>.parameters, <id>.summary, <id>.curves, ... (SHAKEBED_FIT_TABLES).

set(SHAKEBED_RESULTS "${CMAKE_BINARY_DIR}/results" CACHE PATH "Tables, fits and figures")
set(SHAKEBED_NETWORK_TABLES cycle numbers passes pdf fits correlation edges grains)
set(SHAKEBED_FIT_TABLES parameters summary exponents curves comparison correlations points collapse
    ratios)

add_custom_target(refit)
add_custom_target(data-hashes
  COMMAND ${CMAKE_COMMAND} "-DMANIFEST=${PROJECT_SOURCE_DIR}/data_manifest.yaml"
          -P "${PROJECT_SOURCE_DIR}/cmake/DataHashes.cmake"
  VERBATIM)

function(shakebed_target_name out id origin)
  if(origin STREQUAL "quick")
    set(${out} "${id}" PARENT_SCOPE)
  else()
    set(${out} "${id}-${origin}" PARENT_SCOPE)
  endif()
endfunction()

# Sweeps and fits share their names, because figures ask for both by id.
function(shakebed_declare kind id)
  get_property(known GLOBAL PROPERTY SHAKEBED_${kind}_IDS)
  if(id IN_LIST known)
    message(FATAL_ERROR "${id} is declared twice; each link of a chain is declared once")
  endif()
  set_property(GLOBAL APPEND PROPERTY SHAKEBED_${kind}_IDS "${id}")
endfunction()

function(shakebed_existing_file out id path)
  cmake_path(ABSOLUTE_PATH path BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  if(NOT EXISTS "${path}")
    message(FATAL_ERROR "${id}: ${path} does not exist")
  endif()
  set(${out} "${path}" PARENT_SCOPE)
endfunction()

# What link `id` offers over tables of `origin`: the target that makes them and NAME=FILE pairs.
function(shakebed_offer id origin target tables)
  set_property(GLOBAL APPEND PROPERTY SHAKEBED_ORIGINS_${id} ${origin})
  set_property(GLOBAL PROPERTY SHAKEBED_TARGET_${id}_${origin} "${target}")
  set_property(GLOBAL PROPERTY SHAKEBED_TABLES_${id}_${origin} "${tables}")
  foreach(pair IN LISTS tables)
    string(REPLACE "=" "," line "${pair}")
    set_property(GLOBAL APPEND_STRING PROPERTY SHAKEBED_ALL_TABLES "${origin},${line}\n")
  endforeach()
endfunction()

# Targets, NAME=FILE pairs and files that `ids` offer over tables of `origin`; `offered` is false
# when one of them has no such origin.
function(shakebed_collect origin ids offered targets tables files)
  set(${offered} TRUE PARENT_SCOPE)
  set(all_targets)
  set(all_tables)
  foreach(id IN LISTS ids)
    get_property(origins GLOBAL PROPERTY SHAKEBED_ORIGINS_${id})
    if(NOT origins)
      message(FATAL_ERROR "no sweep or fit ${id} is declared before this")
    endif()
    if(NOT origin IN_LIST origins)
      set(${offered} FALSE PARENT_SCOPE)
      return()
    endif()
    get_property(target GLOBAL PROPERTY SHAKEBED_TARGET_${id}_${origin})
    get_property(pairs GLOBAL PROPERTY SHAKEBED_TABLES_${id}_${origin})
    list(APPEND all_targets ${target})
    list(APPEND all_tables ${pairs})
  endforeach()
  list(TRANSFORM all_tables REPLACE "^[^=]*=" "" OUTPUT_VARIABLE all_files)
  set(${targets} "${all_targets}" PARENT_SCOPE)
  set(${tables} "${all_tables}" PARENT_SCOPE)
  set(${files} "${all_files}" PARENT_SCOPE)
endfunction()

# add_sweep(id FILE sweep.yaml [SHIPPED averages.csv] [PROFILES [SHIPPED_PROFILES profiles.csv]])
#   [SNAPSHOTS [SHIPPED_SNAPSHOTS snapshots.csv]] [SERIES] [NETWORKS [REFERENCE numbers.csv]] [STANDARD]
# PROFILES: the height profiles are collected too; SNAPSHOTS: so are the snapshots; SERIES: and how
# beds in containers go, as <id>.series (20 phases of each cycle) and <id>.cycle (160 from T = 10 to
# 11); NETWORKS: the statistics of their snapshots' forces, as <id>.<table> (SHAKEBED_NETWORK_TABLES).
# What SERIES and NETWORKS ship lies beside SHIPPED, as averages.<table>.csv.
function(add_sweep id)
  cmake_parse_arguments(PARSE_ARGV 1 S "PROFILES;SNAPSHOTS;SERIES;NETWORKS;STANDARD"
    "FILE;SHIPPED;SHIPPED_PROFILES;SHIPPED_SNAPSHOTS;REFERENCE" "")
  shakebed_declare(SOURCE "${id}")
  shakebed_existing_file(file "${id}" "${S_FILE}")
  set(profiles_of_sweep quick paper)
  if(S_STANDARD)
    list(APPEND profiles_of_sweep standard)
  endif()
  foreach(profile IN LISTS profiles_of_sweep)
    shakebed_target_name(target "sweep-${id}" ${profile})
    set(table "${SHAKEBED_RESULTS}/${profile}/tables/${id}.csv")
    set(profiles "${SHAKEBED_RESULTS}/${profile}/tables/${id}.profiles.csv")
    set(offers "${id}=${table}")
    set(collecting --csv "${table}.new")
    set(replacing)
    if(S_PROFILES)
      list(APPEND offers "${id}.profiles=${profiles}")
      list(APPEND collecting --profiles "${profiles}.new")
      set(replacing COMMAND ${CMAKE_COMMAND} "-DNEW=${profiles}.new" "-DTARGET=${profiles}"
                            -P "${PROJECT_SOURCE_DIR}/cmake/ReplaceIfChanged.cmake")
    endif()
    set(snapshots "${SHAKEBED_RESULTS}/${profile}/tables/${id}.snapshots.csv")
    if(S_SNAPSHOTS)
      list(APPEND offers "${id}.snapshots=${snapshots}")
      list(APPEND replacing
        COMMAND shakebed sweep snapshots "${file}" --profile ${profile} --csv "${snapshots}.new"
        COMMAND ${CMAKE_COMMAND} "-DNEW=${snapshots}.new" "-DTARGET=${snapshots}"
                -P "${PROJECT_SOURCE_DIR}/cmake/ReplaceIfChanged.cmake")
    endif()
    set(tables "${SHAKEBED_RESULTS}/${profile}/tables")
    if(S_SERIES)
      shakebed_series_of("${id}" "${file}" ${profile} "${tables}" more commands)
      list(APPEND offers ${more})
      list(APPEND replacing ${commands})
    endif()
    if(S_NETWORKS)
      shakebed_networks_of("${id}" "${file}" ${profile} "${tables}" "${S_REFERENCE}" more commands)
      list(APPEND offers ${more})
      list(APPEND replacing ${commands})
    endif()
    list(TRANSFORM offers REPLACE "^[^=]*=" "" OUTPUT_VARIABLE made)
    add_custom_target(${target}
      COMMAND shakebed sweep run "${file}" --profile ${profile}
      COMMAND ${CMAKE_COMMAND} -E make_directory "${SHAKEBED_RESULTS}/${profile}/tables"
      COMMAND shakebed sweep collect "${file}" --profile ${profile} ${collecting}
      COMMAND ${CMAKE_COMMAND} "-DNEW=${table}.new" "-DTARGET=${table}"
              -P "${PROJECT_SOURCE_DIR}/cmake/ReplaceIfChanged.cmake"
      ${replacing}
      BYPRODUCTS ${made}
      # Without SHAKEBED_CACHE in the environment the cache is build/cache below this folder.
      WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
      COMMENT "Sweep ${id} (${profile})" USES_TERMINAL VERBATIM)
    shakebed_offer("${id}" ${profile} ${target} "${offers}")
  endforeach()
  if(S_SHIPPED)
    set(pairs "${id}=${S_SHIPPED}" "${id}.profiles=${S_SHIPPED_PROFILES}"
        "${id}.snapshots=${S_SHIPPED_SNAPSHOTS}")
    set(kinds)
    if(S_SERIES)
      list(APPEND kinds series cycle)
    endif()
    if(S_NETWORKS)
      list(APPEND kinds ${SHAKEBED_NETWORK_TABLES})
    endif()
    foreach(kind IN LISTS kinds)
      string(REGEX REPLACE "csv$" "${kind}.csv" beside "${S_SHIPPED}")
      list(APPEND pairs "${id}.${kind}=${beside}")
    endforeach()
    shakebed_offer_shipped("${id}" ${pairs})
  endif()
endfunction()

# Commands that collect the series of a sweep, and the NAME=FILE pairs they make.
function(shakebed_series_of id file profile folder offers commands)
  set(pairs)
  set(all)
  foreach(choice "series --phases 20" "cycle --phases 160 --from 10 --to 11")
    separate_arguments(words UNIX_COMMAND "${choice}")
    list(POP_FRONT words kind)
    set(table "${folder}/${id}.${kind}.csv")
    list(APPEND pairs "${id}.${kind}=${table}")
    list(APPEND all
      COMMAND shakebed sweep series "${file}" --profile ${profile} ${words} --csv "${table}.new"
      COMMAND ${CMAKE_COMMAND} "-DNEW=${table}.new" "-DTARGET=${table}"
              -P "${PROJECT_SOURCE_DIR}/cmake/ReplaceIfChanged.cmake")
  endforeach()
  set(${offers} "${pairs}" PARENT_SCOPE)
  set(${commands} "${all}" PARENT_SCOPE)
endfunction()

# The same for the statistics of its snapshots' forces, beside the numbers of `reference`.
function(shakebed_networks_of id file profile folder reference offers commands)
  set(options)
  if(reference)
    shakebed_existing_file(numbers "${id}" "${reference}")
    set(options --reference "${numbers}")
  endif()
  set(new "${folder}/${id}.networks.new")
  set(pairs)
  set(all COMMAND shakebed sweep networks "${file}" --profile ${profile} ${options}
                  --csv-folder "${new}")
  foreach(kind IN LISTS SHAKEBED_NETWORK_TABLES)
    set(table "${folder}/${id}.${kind}.csv")
    list(APPEND pairs "${id}.${kind}=${table}")
    list(APPEND all COMMAND ${CMAKE_COMMAND} "-DNEW=${new}/${kind}.csv" "-DTARGET=${table}"
                            -P "${PROJECT_SOURCE_DIR}/cmake/ReplaceIfChanged.cmake")
  endforeach()
  set(${offers} "${pairs}" PARENT_SCOPE)
  set(${commands} "${all}" PARENT_SCOPE)
endfunction()

# add_table(id FILE table.csv): a hand-written table under its id, for every origin.
function(add_table id)
  cmake_parse_arguments(PARSE_ARGV 1 W "" "FILE" "")
  shakebed_declare(SOURCE "${id}")
  shakebed_existing_file(file "${id}" "${W_FILE}")
  foreach(origin quick standard paper shipped)
    shakebed_offer("${id}" ${origin} "" "${id}=${file}")
  endforeach()
endfunction()

# add_scene(id FILE scene.yaml): the contacts of a bed in a container, by kind, as table
# <id>.contacts of every origin. No bed is run.
function(add_scene id)
  cmake_parse_arguments(PARSE_ARGV 1 C "" "FILE" "")
  shakebed_declare(SOURCE "${id}")
  shakebed_existing_file(file "${id}" "${C_FILE}")
  set(table "${SHAKEBED_RESULTS}/scenes/${id}.contacts.csv")
  add_custom_command(OUTPUT "${table}"
    COMMAND shakebed check "${file}" --csv "${table}" > "${table}.txt"
    DEPENDS "${file}" shakebed
    COMMENT "Contacts of ${id}" VERBATIM)
  add_custom_target("scene-${id}" DEPENDS "${table}")
  foreach(origin quick standard paper shipped)
    shakebed_offer("${id}" ${origin} "scene-${id}" "${id}.contacts=${table}")
  endforeach()
endfunction()

# NAME=FILE pairs of tables under data/, as far as they are there: all of a sweep's or none. Pairs
# without a file are passed over.
function(shakebed_offer_shipped id)
  set(offers)
  foreach(pair IN LISTS ARGN)
    string(REGEX REPLACE "^([^=]*)=(.*)$" "\\1;\\2" parts "${pair}")
    list(GET parts 0 name)
    if(pair STREQUAL "${name}=")
      continue()
    endif()
    list(GET parts 1 file)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
    # A glob, so that averages that arrive later are noticed without being asked to configure.
    file(GLOB shipped CONFIGURE_DEPENDS "${file}")
    if(NOT shipped)
      message(STATUS "refit leaves out what needs ${id}: ${file} is not there")
      return()
    endif()
    list(APPEND offers "${name}=${shipped}")
  endforeach()
  shakebed_offer("${id}" shipped "" "${offers}")
endfunction()

# add_fit(id FILE fit.yaml SWEEP sweep-id [USES files...])
# USES: hand-written tables that the fit file names.
function(add_fit id)
  cmake_parse_arguments(PARSE_ARGV 1 F "" "FILE;SWEEP" "USES")
  shakebed_declare(SOURCE "${id}")
  shakebed_existing_file(file "${id}" "${F_FILE}")
  set(uses)
  foreach(used IN LISTS F_USES)
    shakebed_existing_file(used "${id}" "${used}")
    list(APPEND uses "${used}")
  endforeach()
  foreach(origin quick standard paper shipped)
    shakebed_collect(${origin} "${F_SWEEP}" offered sweep_target tables table)
    if(NOT offered)
      continue()
    endif()
    list(GET table 0 table)  # the averages; a sweep's profiles come after them
    shakebed_target_name(target "fit-${id}" ${origin})
    set(folder "${SHAKEBED_RESULTS}/${origin}/fits/${id}")
    set(offers)
    set(outputs)
    foreach(kind IN LISTS SHAKEBED_FIT_TABLES)
      list(APPEND outputs "${folder}/${kind}.csv")
      list(APPEND offers "${id}.${kind}=${folder}/${kind}.csv")
    endforeach()
    add_custom_command(OUTPUT ${outputs}
      COMMAND ${CMAKE_COMMAND} -E make_directory "${folder}"
      COMMAND shakebed fit "${file}" --data "${table}" --csv "${folder}/parameters.csv"
              > "${folder}/report.txt"
      DEPENDS "${file}" ${uses} "${table}" shakebed
      COMMENT "Fit ${id} (${origin})" VERBATIM)
    add_custom_target(${target} DEPENDS ${outputs})
    if(sweep_target)
      add_dependencies(${target} ${sweep_target})
    endif()
    shakebed_offer("${id}" ${origin} ${target} "${offers}")
    if(origin STREQUAL "shipped")
      add_dependencies(refit ${target})
    endif()
  endforeach()
endfunction()

# add_figure(id SPEC figure.yaml NEEDS ids... [USES files...] [TABLE])
# USES: files beside the specification that it names (script, hand-written tables). TABLE: the
# figure is a table (.csv, .txt, .md) and not a picture (.csv, .svg, .png).
function(add_figure id)
  cmake_parse_arguments(PARSE_ARGV 1 G "TABLE" "SPEC" "NEEDS;USES")
  shakebed_declare(FIGURE "${id}")
  shakebed_existing_file(spec "${id}" "${G_SPEC}")
  set(uses)
  foreach(file IN LISTS G_USES)
    shakebed_existing_file(used "${id}" "${file}")
    list(APPEND uses "${used}")
  endforeach()
  set(endings csv svg png)
  if(G_TABLE)
    set(endings csv txt md)
  endif()
  foreach(origin quick standard paper shipped)
    shakebed_collect(${origin} "${G_NEEDS}" offered needed_targets tables files)
    if(NOT offered)
      continue()
    endif()
    shakebed_target_name(target "${id}" ${origin})
    set(folder "${SHAKEBED_RESULTS}/${origin}/figures")
    list(TRANSFORM endings PREPEND "${folder}/${id}." OUTPUT_VARIABLE outputs)
    list(TRANSFORM tables PREPEND "--table=" OUTPUT_VARIABLE table_options)
    add_custom_command(OUTPUT ${outputs}
      COMMAND shakebed figure "${id}" --spec "${spec}" ${table_options}
              --output "${folder}"
      DEPENDS "${spec}" ${uses} ${files} shakebed
      COMMENT "Figure ${id} (${origin})" VERBATIM)
    add_custom_target(${target} DEPENDS ${outputs})
    if(needed_targets)
      add_dependencies(${target} ${needed_targets})
    endif()
    set_property(GLOBAL PROPERTY SHAKEBED_OUTPUTS_${id}_${origin} "${outputs}")
    if(origin STREQUAL "shipped")
      add_dependencies(refit ${target})
    endif()
  endforeach()
  set_property(GLOBAL PROPERTY SHAKEBED_NEEDS_${id} "${G_NEEDS}")
endfunction()

# add_job(name FIGURES ids... [PRINTS table-id] [STANDARD]): one word for several figures, over beds; the text
# of a table is printed at the end.
function(add_job name)
  cmake_parse_arguments(PARSE_ARGV 1 J "STANDARD" "PRINTS" "FIGURES")
  set(profiles quick paper)
  if(J_STANDARD)
    list(APPEND profiles standard)
  endif()
  foreach(profile IN LISTS profiles)
    shakebed_target_name(job "${name}" ${profile})
    set(figures)
    foreach(id IN LISTS J_FIGURES)
      shakebed_target_name(figure "${id}" ${profile})
      list(APPEND figures ${figure})
    endforeach()
    set(printing)
    if(J_PRINTS)
      set(printing COMMAND ${CMAKE_COMMAND} -E cat
                           "${SHAKEBED_RESULTS}/${profile}/figures/${J_PRINTS}.txt")
    endif()
    add_custom_target(${job} ${printing}
      COMMAND ${CMAKE_COMMAND} -E echo "Figures and tables: ${SHAKEBED_RESULTS}/${profile}/figures"
      USES_TERMINAL VERBATIM)
    add_dependencies(${job} ${figures})
  endforeach()
endfunction()

# pipeline.csv: the figures that are declared, for the manifest's test and the report's index.
# tables.csv: every table by origin and name, for the claims.
function(shakebed_write_pipeline)
  set(lines "figure,needs,origins\n")
  get_property(figures GLOBAL PROPERTY SHAKEBED_FIGURE_IDS)
  foreach(id IN LISTS figures)
    get_property(needs GLOBAL PROPERTY SHAKEBED_NEEDS_${id})
    set(origins)
    foreach(origin quick standard paper shipped)
      get_property(outputs GLOBAL PROPERTY SHAKEBED_OUTPUTS_${id}_${origin})
      if(outputs)
        list(APPEND origins ${origin})
      endif()
    endforeach()
    list(JOIN needs " " needs)
    list(JOIN origins " " origins)
    string(APPEND lines "${id},${needs},${origins}\n")
  endforeach()
  file(GENERATE OUTPUT "${CMAKE_BINARY_DIR}/pipeline.csv" CONTENT "${lines}")
  get_property(tables GLOBAL PROPERTY SHAKEBED_ALL_TABLES)
  file(GENERATE OUTPUT "${CMAKE_BINARY_DIR}/tables.csv" CONTENT "origin,table,file\n${tables}")
endfunction()

# claims: the papers' claims with our numbers and verdicts, from the shipped averages and from beds
# computed so far. record-claims keeps the verdicts from the shipped averages, which a test compares.
function(shakebed_add_claims)
  set(manifest "${PROJECT_SOURCE_DIR}/data_manifest.yaml")
  set(verdicts "${PROJECT_SOURCE_DIR}/data/verdicts.csv")
  foreach(word claims record-claims)
    set(option --recorded)
    if(word STREQUAL "record-claims")
      set(option --record)
    endif()
    add_custom_target(${word}
      COMMAND shakebed claims "${manifest}" --tables "${CMAKE_BINARY_DIR}/tables.csv"
              --csv "${SHAKEBED_RESULTS}/claims.csv" ${option} "${verdicts}"
      USES_TERMINAL VERBATIM)
    add_dependencies(${word} refit)
  endforeach()
endfunction()
