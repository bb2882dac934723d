# Installs the libraries that others link, so that find_package(emca COMPONENTS server client) works.
include(CMakePackageConfigHelpers)

set(EMCA_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/emca)
set(installed)
foreach(part core recorder query probe protocol server c adapter client analysis imageio)
  if(TARGET emca_${part})
    list(APPEND installed emca_${part})
    install(DIRECTORY libs/${part}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endif()
endforeach()
if(TARGET emca_explorer)
  # What plugins of the explorer are built with: headers, and the function emca_add_plugin.
  list(APPEND installed emca_explorer)
  install(DIRECTORY apps/explorer/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
install(TARGETS ${installed} EXPORT emcaTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET emca_c)
  # For those who do not build with CMake: cc $(pkg-config --cflags --libs emca). Moves along with the prefix.
  file(RELATIVE_PATH EMCA_PREFIX_FROM_PC /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  configure_file(cmake/emca.pc.in ${CMAKE_CURRENT_BINARY_DIR}/emca.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/emca.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()
install(EXPORT emcaTargets NAMESPACE emca:: DESTINATION ${EMCA_PACKAGE_DIR})
configure_package_config_file(cmake/emcaConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/emcaConfig.cmake
  INSTALL_DESTINATION ${EMCA_PACKAGE_DIR})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/emcaConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/emcaConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/emcaConfigVersion.cmake
  cmake/EmcaOpenEXR.cmake cmake/EmcaPlugin.cmake DESTINATION ${EMCA_PACKAGE_DIR})
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/emca/scenes)
