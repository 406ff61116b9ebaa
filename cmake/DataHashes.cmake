# cmake -DMANIFEST=data_manifest.yaml -P DataHashes.cmake
# Writes the SHA-256 of every file under `files:` of the manifest anew. A new file is first listed
# by hand, as `  data/...csv: {sha256: new, made_by: "..."}`: who made it is not for a script to say.
cmake_path(GET MANIFEST PARENT_PATH folder)
file(READ "${MANIFEST}" text)
string(REGEX MATCHALL "\n  data/[^:\n]+: {sha256: [0-9a-z]+" entries "${text}")
foreach(entry IN LISTS entries)
  string(REGEX REPLACE "^\n  (data/[^:\n]+): .*$" "\\1" file "${entry}")
  file(SHA256 "${folder}/${file}" hash)
  string(REPLACE "${entry}" "\n  ${file}: {sha256: ${hash}" text "${text}")
  message(STATUS "${hash}  ${file}")
endforeach()
file(WRITE "${MANIFEST}.new" "${text}")
file(RENAME "${MANIFEST}.new" "${MANIFEST}")
