# emca_add_plugin(NAME SOURCES files... [LIBRARIES targets...])
# A plugin of the explorer: a shared library that exports emca_explorer_plugin and nothing else. Used by EMCA itself and,
# through find_package(emca COMPONENTS explorer), by anybody else. docs/plugins.md
function(emca_add_plugin name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(${name} MODULE ${arg_SOURCES})
  set_target_properties(${name} PROPERTIES PREFIX "" AUTOMOC ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(${name} PRIVATE emca::explorer ${arg_LIBRARIES})
  # What is missing is found when the plugin is linked, not when a person opens it; the code of EMCA's libraries inside
  # of it stays its own.
  target_link_options(${name} PRIVATE LINKER:--no-undefined LINKER:--exclude-libs,ALL)
endfunction()
