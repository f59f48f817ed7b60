# What verification/, experiments/ and tests/ need beyond Eigen. `./run` installs all of it.

find_package(Boost 1.74 REQUIRED)
# It warns of every build that is not Release.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE ON)
find_package(CGAL 5.5 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(GTest REQUIRED CONFIG)
# Debian's package misses a file of PyImath's and says so: harmless.
find_package(OpenEXR REQUIRED CONFIG)
find_package(PNG REQUIRED)
find_package(Threads REQUIRED)
find_package(benchmark REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(rapidcheck REQUIRED)
find_package(tinyobjloader REQUIRED)

# Ceres is used for its Jets, which are headers; its own package would ask for glog and the solvers.
find_path(CERES_INCLUDE_DIR ceres/jet.h REQUIRED)
add_library(ceres_jets INTERFACE IMPORTED)
target_include_directories(ceres_jets INTERFACE "${CERES_INCLUDE_DIR}")

# None of these four comes with a CMake package. Debian calls Arb's library flint-arb, others arb, FLINT 3 has it built in.
find_path(ARB_INCLUDE_DIR NAMES arb.h PATH_SUFFIXES flint REQUIRED)
find_library(ARB_LIBRARY NAMES flint-arb arb flint REQUIRED)
find_library(FLINT_LIBRARY flint REQUIRED)
find_library(MPFR_LIBRARY mpfr REQUIRED)
find_library(GMP_LIBRARY gmp REQUIRED)

# Boost.Multiprecision's mpfr_float.
add_library(multiprecision_mpfr INTERFACE IMPORTED)
target_link_libraries(multiprecision_mpfr INTERFACE Boost::headers "${MPFR_LIBRARY}" "${GMP_LIBRARY}")

add_library(arb INTERFACE IMPORTED)
target_include_directories(arb INTERFACE "${ARB_INCLUDE_DIR}")
target_link_libraries(arb INTERFACE "${ARB_LIBRARY}" "${FLINT_LIBRARY}" "${MPFR_LIBRARY}" "${GMP_LIBRARY}")

# Embree's own package looks for TBB's, which nothing here links.
find_path(EMBREE_INCLUDE_DIR embree3/rtcore.h REQUIRED)
find_library(EMBREE_LIBRARY embree3 REQUIRED)
add_library(embree3 INTERFACE IMPORTED)
target_include_directories(embree3 INTERFACE "${EMBREE_INCLUDE_DIR}")
target_link_libraries(embree3 INTERFACE "${EMBREE_LIBRARY}")
