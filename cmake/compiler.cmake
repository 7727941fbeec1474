# C++17, Release unless told otherwise, warnings as errors only where -DWARNINGS_AS_ERRORS=ON.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
# No fast-math, and no -march=native unless asked for: results are the same on every x86-64 machine.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
# Nobody asks for errno after a root: without it, loops with roots are vectorised.
add_compile_options(-fno-math-errno)
option(PLM_NATIVE "Use all that this machine's processor can do; results differ in last bits" OFF)
if(PLM_NATIVE)
  add_compile_options(-march=native)
endif()

# Findings end the program. -O1, of a release, keeps them readable and compiles in half the time.
option(SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
if(SANITIZE)
  set(CMAKE_CXX_FLAGS_RELEASE "-O1 -DNDEBUG")
  add_compile_options(-g1 -fno-omit-frame-pointer -fsanitize=address,undefined
                      -fno-sanitize-recover=all)
  add_link_options(-fsanitize=address,undefined)
endif()

option(WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
add_compile_options(-Wall -Wextra)
# Programs load only what they use: an estimator none of the hundreds of libraries that read images.
if(NOT APPLE)
  add_link_options(-Wl,--as-needed)
endif()
# Libraries need it; programs have it too, to share their precompiled headers.
add_compile_options(-fPIC)
if(WARNINGS_AS_ERRORS)
  # GCC 12 takes members of Eigen matrices in optionals for uninitialised when it inlines them.
  add_compile_options(-Werror -Wno-error=maybe-uninitialized)
endif()
