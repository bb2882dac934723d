# Which names the linker has for a renderer's functions: they depend on the person's headers. A source file of ours takes
# their addresses into variables emca_name_...; this reads its assembly and writes the names as macros
# EMCA_NAME_..., and as --wrap options for the linker.
#
#   cmake -DASSEMBLY=... -DHEADER=... -DOPTIONS=... -P observed_names.cmake
#
# and, included, emca_observed_names(NAMES INCLUDE_DIRECTORIES...): rules that make NAMES.h and NAMES.rsp of
# observed_names.cpp in this folder.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  function(emca_observed_names names)
    set(includes)
    list(REMOVE_ITEM ARGN ${CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES})  # named once more, they hide themselves
    foreach(directory IN LISTS ARGN)
      list(APPEND includes -isystem ${directory})
    endforeach()
    add_custom_command(OUTPUT ${names}.h ${names}.rsp
      COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -w -O0 -S ${CMAKE_CURRENT_SOURCE_DIR}/observed_names.cpp -o ${names}.s
        -MD -MF ${names}.d -MT ${names}.h -I${CMAKE_CURRENT_SOURCE_DIR} -I${PROJECT_SOURCE_DIR}/libs/core/include ${includes}
      COMMAND ${CMAKE_COMMAND} -DASSEMBLY=${names}.s -DHEADER=${names}.h -DOPTIONS=${names}.rsp
        -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/observed_names.cpp ${CMAKE_CURRENT_FUNCTION_LIST_FILE} DEPFILE ${names}.d VERBATIM)
  endfunction()
  return()
endif()

file(READ "${ASSEMBLY}" assembly)
string(REGEX MATCHALL "\nemca_name_[a-z_]+:\n[ \t]*\\.quad[ \t]+[A-Za-z0-9_]+" definitions "${assembly}")
set(header "// Made by observed_names.cmake.\n")
set(options "")
foreach(definition IN LISTS definitions)
  string(REGEX MATCH "emca_name_([a-z_]+):\n[ \t]*\\.quad[ \t]+([A-Za-z0-9_]+)" ignored "${definition}")
  string(APPEND header "#define EMCA_NAME_${CMAKE_MATCH_1} \"${CMAKE_MATCH_2}\"\n")
  string(APPEND options "-Wl,--wrap=${CMAKE_MATCH_2}\n")
endforeach()
if(options STREQUAL "")
  message(FATAL_ERROR "No name found in ${ASSEMBLY}: this assembly is of a kind that observed_names.cmake does not know.")
endif()
file(WRITE "${HEADER}" "${header}")
file(WRITE "${OPTIONS}" "${options}")
