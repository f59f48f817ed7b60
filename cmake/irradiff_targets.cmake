# How the targets of this project are made: every library, program and test goes through these functions.

# Compile options of our own code. Never exported: who links irradiff chooses their own warnings.
add_library(irradiff_options INTERFACE)
target_compile_features(irradiff_options INTERFACE cxx_std_20)
target_include_directories(irradiff_options INTERFACE "${PROJECT_SOURCE_DIR}")
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(irradiff_options INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    # g++ 12 takes the small buffer of a moved std::string for an overlap (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    # The error bounds hold for the operations as written, not for fused ones.
    -ffp-contract=off)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # g++ leaves it out of -Wconversion in C++; Eigen's signed indices meet std::size_t everywhere.
    target_compile_options(irradiff_options INTERFACE -Wno-sign-conversion)
  endif()
endif()

# Tests are compiled more often than they run long: -O1 takes a fifth less time than -O2. What they test keeps -O2.
set(irradiff_test_optimization "$<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O1>")

# What most sources include is compiled once: reading Eigen, GoogleTest and Boost.Multiprecision costs more than most of
# our own code. ./run tidy compiles without, so that a source that forgot an include is found.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# irradiff_precompile(TARGET libraries ...): with multiprecision or else JSON where the libraries have it, with GoogleTest
# for programs: only tests come here among those.
function(irradiff_precompile target)
  if("CGAL::CGAL" IN_LIST ARGN)
    return()  # -frounding-math, which CGAL needs, does not go with what was compiled without it
  endif()
  set(libraries)
  set(headers
    <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <cmath> <functional> <optional> <span> <sstream> <string> <vector>)
  get_target_property(type ${target} TYPE)
  set(name precompiled_library)
  if(type STREQUAL "EXECUTABLE")
    set(name precompiled_test)
    list(APPEND headers <gmock/gmock.h> <gtest/gtest.h>)
  endif()
  if("multiprecision_mpfr" IN_LIST ARGN OR "irradiff_closed_forms" IN_LIST ARGN)
    string(APPEND name "_multiprecision")
    list(APPEND headers <boost/multiprecision/mpfr.hpp>)
    set(libraries multiprecision_mpfr)
  elseif("nlohmann_json::nlohmann_json" IN_LIST ARGN OR "irradiff_io" IN_LIST ARGN)
    string(APPEND name "_json")
    list(APPEND headers <nlohmann/json.hpp>)
    set(libraries nlohmann_json::nlohmann_json)
  endif()
  if(NOT TARGET ${name})
    # Position independent code differs between programs and libraries, so the owner is one or the other.
    set(source "${PROJECT_BINARY_DIR}/${name}.cpp")
    if(type STREQUAL "EXECUTABLE")
      file(CONFIGURE OUTPUT "${source}" CONTENT "int main() {}\n")
      add_executable(${name} EXCLUDE_FROM_ALL "${source}")
      target_compile_options(${name} PRIVATE "${irradiff_test_optimization}")
      target_link_libraries(${name} PRIVATE GTest::gmock GTest::gtest)
    else()
      file(CONFIGURE OUTPUT "${source}" CONTENT "")
      add_library(${name} STATIC EXCLUDE_FROM_ALL "${source}")
    endif()
    target_link_libraries(${name} PRIVATE irradiff_options Eigen3::Eigen ${libraries})
    target_precompile_headers(${name} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()

# irradiff_library(NAME [SOURCES ...] [PUBLIC libraries] [PRIVATE libraries])
# A static library; without SOURCES the library of a room that has headers only.
function(irradiff_library name)
  cmake_parse_arguments(PARSE_ARGV 1 room "" "" "SOURCES;PUBLIC;PRIVATE")
  irradiff_reject_unparsed(irradiff_library ${name} "${room_UNPARSED_ARGUMENTS}" "${room_KEYWORDS_MISSING_VALUES}")
  if(room_SOURCES)
    add_library(${name} STATIC ${room_SOURCES})
    target_link_libraries(${name} PUBLIC ${room_PUBLIC} PRIVATE ${room_PRIVATE} irradiff_options)
    irradiff_precompile(${name} ${room_PUBLIC} ${room_PRIVATE})
  elseif(room_PRIVATE)
    message(FATAL_ERROR "irradiff_library(${name}): a library without SOURCES has no PRIVATE libraries: ${room_PRIVATE}")
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${room_PUBLIC})
  endif()
endfunction()

# irradiff_program(NAME SOURCES ... [LIBRARIES ...])
# A program at build/<preset>/NAME.
function(irradiff_program name)
  cmake_parse_arguments(PARSE_ARGV 1 program "" "" "SOURCES;LIBRARIES")
  irradiff_reject_unparsed(irradiff_program ${name} "${program_UNPARSED_ARGUMENTS}" "${program_KEYWORDS_MISSING_VALUES}")
  add_executable(${name} ${program_SOURCES})
  target_link_libraries(${name} PRIVATE ${program_LIBRARIES} irradiff_options)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
endfunction()

# The programs that the sanitizers run.
add_custom_target(unit_tests)

# irradiff_test(NAME SOURCES ... [LIBRARIES ...] [LABELS ...] [TIMEOUT seconds] [ARGUMENTS ...] [ENVIRONMENT VAR=value ...])
# One GoogleTest (and GoogleMock) program that is one test of ctest. Without LABELS it is a `unit` test: those run under
# the sanitizers too, so give a slow or timed one another label. It runs in the project's root, where data/ is.
function(irradiff_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS;ARGUMENTS;ENVIRONMENT")
  irradiff_reject_unparsed(irradiff_test ${name} "${test_UNPARSED_ARGUMENTS}" "${test_KEYWORDS_MISSING_VALUES}")
  if(NOT test_LABELS)
    set(test_LABELS unit)
  endif()
  if(NOT test_TIMEOUT)
    set(test_TIMEOUT 300)
  endif()
  add_executable(${name} ${test_SOURCES})
  target_link_libraries(${name} PRIVATE ${test_LIBRARIES} GTest::gmock GTest::gtest GTest::gtest_main irradiff_options)
  irradiff_precompile(${name} ${test_LIBRARIES})
  target_compile_options(${name} PRIVATE "${irradiff_test_optimization}")
  # In precompiled std::string g++ 12 sees overflows of its small buffer that are not there, in the same bug as
  # -Wrestrict. Under the sanitizers a real one would stop the test.
  target_compile_options(${name} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow>")
  if("unit" IN_LIST test_LABELS)
    add_dependencies(unit_tests ${name})
  endif()
  add_test(NAME ${name} COMMAND ${name} ${test_ARGUMENTS} WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
  set_tests_properties(${name} PROPERTIES
    LABELS "${test_LABELS}" TIMEOUT ${test_TIMEOUT} ENVIRONMENT "${test_ENVIRONMENT}")
endfunction()

# A misspelt keyword would otherwise pass for one more source file.
function(irradiff_reject_unparsed function name unparsed without_value)
  if(unparsed OR without_value)
    message(FATAL_ERROR "${function}(${name}): unknown argument or keyword without a value: ${unparsed} ${without_value}")
  endif()
endfunction()
