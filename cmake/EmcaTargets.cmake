# Targets of this project: one function each for a library, a program and a test, so that warnings,
# sanitizers and install rules are stated once.

# Flags that every target of ours gets, and no target of others.
add_library(emca_flags INTERFACE)
target_compile_options(emca_flags INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wunused -Wnull-dereference -Wdouble-promotion -Wformat=2 -Wno-missing-field-initializers
    # Replay promises equal bits, so a compiler may not fuse a*b+c in one place and not in another.
    -ffp-contract=off>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports these from inside the standard library at -O2 and above.
  target_compile_options(emca_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-null-dereference -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-maybe-uninitialized>)
endif()
# A library that a package's CMake file names but that no code of ours calls would cost time at each start.
target_link_options(emca_flags INTERFACE LINKER:--as-needed)
if(EMCA_SANITIZE)
  target_compile_options(emca_flags INTERFACE -fsanitize=${EMCA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  # Not UBSan's check for null: GCC 12 takes some thread-local objects for null, since it branches on flags that
  # no instruction has set. AddressSanitizer reports what is really null.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(emca_flags INTERFACE -fno-sanitize=null)
  endif()
  target_link_options(emca_flags INTERFACE -fsanitize=${EMCA_SANITIZE})
endif()

# A build that counts how often each branch is taken, then one that is optimised for that: scripts/build-profiled.sh.
set(EMCA_PROFILE "" CACHE STRING "generate or use: a build in two steps (scripts/build-profiled.sh)")
if(EMCA_PROFILE AND NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  message(FATAL_ERROR "EMCA_PROFILE asks for GCC, but the compiler is ${CMAKE_CXX_COMPILER_ID}: leave it out, or choose GCC.")
elseif(EMCA_PROFILE STREQUAL "generate")
  target_compile_options(emca_flags INTERFACE -fprofile-generate -fprofile-update=prefer-atomic)
  target_link_options(emca_flags INTERFACE -fprofile-generate)
elseif(EMCA_PROFILE STREQUAL "use")
  # What the scenes did not run is optimised as without a profile.
  target_compile_options(emca_flags INTERFACE -fprofile-use -fprofile-correction -fprofile-partial-training -Wno-missing-profile)
  set(CMAKE_INTERPROCEDURAL_OPTIMIZATION ON)
elseif(EMCA_PROFILE)
  message(FATAL_ERROR "EMCA_PROFILE is \"${EMCA_PROFILE}\", but known are generate and use.")
endif()

# emca_add_library(NAME [SHARED] SOURCES... [PUBLIC targets] [PRIVATE targets] [TESTS files] [TEST_LIBRARIES targets])
# Makes emca::NAME from libs/NAME, and the program NAME_test from its *_test.cpp files. SHARED: for languages that know
# nothing of C++; its headers ask for no standard of that.
function(emca_add_library name)
  cmake_parse_arguments(arg "SHARED" "" "SOURCES;PUBLIC;PRIVATE;TESTS;TEST_LIBRARIES" ${ARGN})
  if(arg_SHARED)
    add_library(emca_${name} SHARED ${arg_SOURCES})
    target_compile_features(emca_${name} PRIVATE cxx_std_20)
  else()
    add_library(emca_${name} STATIC ${arg_SOURCES})
    target_compile_features(emca_${name} PUBLIC cxx_std_20)
  endif()
  add_library(emca::${name} ALIAS emca_${name})
  set_target_properties(emca_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(emca_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(emca_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:emca_flags>)
  if(EMCA_BUILD_TESTS AND arg_TESTS)
    emca_add_test(${name}_test SOURCES ${arg_TESTS} LIBRARIES emca::${name} ${arg_TEST_LIBRARIES})
    target_include_directories(${name}_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  endif()
endfunction()

# emca_add_program(NAME SOURCES... LIBRARIES...)
function(emca_add_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} emca_flags)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# emca_add_test(NAME SOURCES... LIBRARIES... [TIMEOUT seconds] [LABELS ...])
# One GoogleTest program, one CTest entry. Fixed inputs live beside the test: EMCA_SOURCE_DIR is the checkout.
function(emca_add_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main emca_flags)
  target_compile_definitions(${name} PRIVATE EMCA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" EMCA_BINARY_DIR="${CMAKE_BINARY_DIR}")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS "${arg_LABELS}")
endfunction()

# emca_add_part(FOLDER [NEEDS dependency...])
# Adds a folder if all it needs was found; otherwise leaves it out and remembers why for one clear line.
function(emca_add_part folder)
  cmake_parse_arguments(arg "" "" "NEEDS" ${ARGN})
  if(EMCA_ONLY_PARTS AND NOT folder IN_LIST EMCA_ONLY_PARTS)
    return()
  endif()
  if(NOT EXISTS "${PROJECT_SOURCE_DIR}/${folder}/CMakeLists.txt")
    return()
  endif()
  set(missing)
  foreach(need IN LISTS arg_NEEDS)
    if(NOT EMCA_HAVE_${need})
      list(APPEND missing ${need})
    endif()
  endforeach()
  if(missing)
    list(JOIN missing ", " missing)
    set_property(GLOBAL APPEND PROPERTY EMCA_LEFT_OUT "${folder} (needs ${missing})")
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY EMCA_PARTS "${folder}")
  add_subdirectory(${folder})
endfunction()

function(emca_report_parts)
  get_property(left_out GLOBAL PROPERTY EMCA_LEFT_OUT)
  foreach(line IN LISTS left_out)
    message(STATUS "EMCA: left out ${line}; scripts/install-deps.sh installs it on Debian")
  endforeach()
endfunction()
