# Finds OpenEXR 3 for us and for those who link emca::imageio. Not by its own CMake package: Debian's names files of
# packages that it does not depend on, and CMake complains or stops where they are absent.
if(NOT TARGET OpenEXR::OpenEXR)
  find_path(EMCA_OPENEXR_INCLUDE OpenEXR/ImfMultiPartInputFile.h)
  find_path(EMCA_IMATH_INCLUDE Imath/ImathBox.h)
  find_library(EMCA_OPENEXR_LIBRARY OpenEXR)
  if(EMCA_OPENEXR_INCLUDE AND EMCA_IMATH_INCLUDE AND EMCA_OPENEXR_LIBRARY)
    add_library(OpenEXR::OpenEXR SHARED IMPORTED)
    set_target_properties(OpenEXR::OpenEXR PROPERTIES IMPORTED_LOCATION ${EMCA_OPENEXR_LIBRARY})
    target_include_directories(OpenEXR::OpenEXR INTERFACE
      ${EMCA_OPENEXR_INCLUDE} ${EMCA_OPENEXR_INCLUDE}/OpenEXR ${EMCA_IMATH_INCLUDE}/Imath)
  endif()
endif()
if(TARGET OpenEXR::OpenEXR)
  set(OpenEXR_FOUND TRUE)
endif()
