# C++17, Release by default, warnings as errors only with -DWARNINGS_AS_ERRORS=ON.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
# No fast-math, and no -march=native by default: results are the same on every x86-64 machine.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
# errno is not used after square roots; without it, loops with square roots are vectorized.
add_compile_options(-fno-math-errno)
option(PLM_NATIVE "Use all that this machine's processor can do; results differ in last bits" OFF)
if(PLM_NATIVE)
  add_compile_options(-march=native)
elseif(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64|AMD64")
  # Products are rounded before they are added, also by Eigen, as on x86-64, whose compilers fuse both
  # only with -march=native.
  add_compile_options(-ffp-contract=off -U__ARM_FEATURE_FMA)
endif()

# Findings abort the program. -O1 keeps their stack traces readable and compiles in half the time.
option(SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
if(SANITIZE)
  set(CMAKE_CXX_FLAGS_RELEASE "-O1 -DNDEBUG")
  add_compile_options(-g1 -fno-omit-frame-pointer -fsanitize=address,undefined
                      -fno-sanitize-recover=all)
  add_link_options(-fsanitize=address,undefined)
endif()

option(WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
add_compile_options(-Wall -Wextra)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12)
    add_compile_options(-Wno-maybe-uninitialized)  # false for members of optionals
  endif()
  # Collects garbage later, for 15 % more memory and a tenth less time.
  add_compile_options(--param=ggc-min-heapsize=524288)
endif()
# Programs load only libraries that they use: the estimator does not need the hundreds that read images.
if(NOT APPLE)
  add_link_options(-Wl,--as-needed)
endif()
# Required by libraries; programs use it as well, to share their precompiled headers.
add_compile_options(-fPIC)
if(WARNINGS_AS_ERRORS)
  # GCC 12 falsely reports inlined members of Eigen matrices as uninitialized or out of bounds.
  add_compile_options(-Werror -Wno-error=maybe-uninitialized -Wno-error=array-bounds)
endif()
