# One library a module. Sources are found by pattern, so adding a file is one step.
# A module that needs more than Eigen says so in src/<module>/module.cmake.

add_library(osteon_flags INTERFACE)
target_compile_options(osteon_flags INTERFACE
  # Joined, a local name may be that of another file's constant, which clang warns of.
  -Wall -Wextra -Wpedantic $<$<NOT:$<AND:$<BOOL:${OSTEON_JOINED}>,$<CXX_COMPILER_ID:Clang>>>:-Wshadow>
  -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  # One rounding a operation, on every compiler: recordings replay bit by bit.
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(osteon_flags INTERFACE
    # g++ 12 drops the rounding of double -> float -> double where it joins neighbouring values.
    -fno-tree-slp-vectorize
    # g++ 12 warns of overlap in "literal" + std::string (GCC bug 105651).
    -Wno-restrict)
endif()
target_include_directories(osteon_flags INTERFACE "${CMAKE_SOURCE_DIR}/include")
if(OSTEON_SANITIZE)
  # Before a target's own options, which may take some of it back.
  add_compile_options(
    -fsanitize=${OSTEON_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(osteon_flags INTERFACE -fsanitize=${OSTEON_SANITIZE})
  if(OSTEON_SANITIZE MATCHES "undefined")
    # These stand before every access to memory and take a third of the time to build; a null pointer
    # and what lies outside of an object stop the program under AddressSanitizer all the same.
    add_compile_options(-fno-sanitize=vptr,object-size,null,alignment)
  endif()
endif()

# Headers parsed once. A target of its own makes each set: one without any module's definitions.
function(osteon_make_headers target header)
  add_library(${target} OBJECT "${CMAKE_SOURCE_DIR}/cmake/headers.cpp")
  target_link_libraries(${target} PRIVATE osteon_flags Eigen3::Eigen ${ARGN})
  target_precompile_headers(${target} PRIVATE "${header}")
endfunction()
# Tells the compiler to leave marks by which ccache can tell. g++ 12 then warns of overruns inside
# std::string that cannot be (GCC bugs 105329, 105651): it no longer knows the header for a system's.
function(osteon_use_headers target from)
  target_precompile_headers(${target} REUSE_FROM ${from})
  target_compile_options(${target} PRIVATE
    "$<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>" $<$<CXX_COMPILER_ID:Clang>:-Xclang -fno-pch-timestamp>)
endfunction()

# Of the modules where OSTEON_PCH asks for it.
if(OSTEON_PCH)
  osteon_make_headers(osteon_headers "${CMAKE_SOURCE_DIR}/cmake/headers.h")
endif()
function(osteon_share_headers target)
  if(OSTEON_PCH)
    osteon_use_headers(${target} osteon_headers)
  endif()
endfunction()

# What runs once, or once a picture, is less optimised and builds in two thirds of the time: what lies
# around the modules, and these modules.
set(OSTEON_LIGHT_MODULES results)
set(OSTEON_LIGHT_FLAGS "")
# Under sanitizers so is what no replay needs: not optimised, not counted for the fuzzer and watched
# by AddressSanitizer alone, it builds in less than half the time.
if(OSTEON_SANITIZE)
  list(APPEND OSTEON_LIGHT_MODULES xray media render surgeon)
  set(OSTEON_LIGHT_FLAGS -O0)
  if(OSTEON_SANITIZE MATCHES "fuzzer-no-link")
    list(APPEND OSTEON_LIGHT_FLAGS -fno-sanitize=undefined,fuzzer-no-link)
  endif()
  if(OSTEON_SANITIZE MATCHES "thread")
    # The loops' tests run none of these at the rate of a loop.
    list(APPEND OSTEON_LIGHT_MODULES image procedure tissue)
  endif()
endif()
# Headers of its own: g++ optimises all that follows as it did the headers, whatever its command says.
if(OSTEON_PCH)
  osteon_make_headers(osteon_light_headers "${CMAKE_SOURCE_DIR}/cmake/headers.h")
  target_compile_options(osteon_light_headers PRIVATE $<$<CONFIG:Release>:-O1>
    ${OSTEON_LIGHT_FLAGS})
endif()
function(osteon_share_light_headers target)
  # Of moved std::optional, g++ 12 says at -O1 what is not so (GCC bug 80635).
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1> ${OSTEON_LIGHT_FLAGS}
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  if(OSTEON_PCH)
    osteon_use_headers(${target} osteon_light_headers)
  endif()
endfunction()

# Compiles a target's sources a few at a time where OSTEON_JOINED asks for it.
function(osteon_join target)
  if(OSTEON_JOINED)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  endif()
endfunction()

# Optimises these files in a debug build too, which would take minutes to start without; the results
# are the same bits. They are compiled alone there: headers that are parsed once would undo it.
function(osteon_optimise_in_debug)
  if(CMAKE_BUILD_TYPE STREQUAL "Debug")
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O2 SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# As osteon_join, for a target that many files join: a file's own name says whether a new batch
# begins with it, so that one more file changes one batch and not all after it.
function(osteon_join_by_name target)
  if(NOT OSTEON_JOINED)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  set(room "")
  foreach(source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    get_filename_component(name "${source}" NAME_WE)
    string(MD5 hash "${name}")
    if(NOT folder STREQUAL room OR hash MATCHES "^0" OR in_batch GREATER 15)
      set(batch "${name}")
      set(in_batch 0)
      set(room "${folder}")
    endif()
    math(EXPR in_batch "${in_batch} + 1")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${batch}")
  endforeach()
endfunction()

function(osteon_module name)
  cmake_parse_arguments(ARG "" "" "DEPS" ${ARGN})
  # Rooms after the module's own folder: what is compiled together stays in one room, nearly always.
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${name}/*.cpp")
  file(GLOB in_rooms CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${name}/*/*.cpp")
  list(APPEND sources ${in_rooms})
  if(NOT sources)
    return()
  endif()
  add_library(osteon_${name} STATIC ${sources})
  add_library(osteon::${name} ALIAS osteon_${name})
  target_include_directories(osteon_${name} PRIVATE "${CMAKE_SOURCE_DIR}/src/${name}")
  target_link_libraries(osteon_${name} PRIVATE osteon_flags PUBLIC Eigen3::Eigen)
  target_include_directories(osteon_${name} PUBLIC "${CMAKE_SOURCE_DIR}/include")
  foreach(dep IN LISTS ARG_DEPS)
    if(TARGET osteon_${dep})
      target_link_libraries(osteon_${name} PUBLIC osteon_${dep})
    endif()
  endforeach()
  if(name IN_LIST OSTEON_LIGHT_MODULES)
    osteon_share_light_headers(osteon_${name})
  else()
    osteon_share_headers(osteon_${name})
  endif()
  osteon_join(osteon_${name})
  include("${CMAKE_SOURCE_DIR}/src/${name}/module.cmake" OPTIONAL)
  set(needs ${name})
  foreach(dep IN LISTS ARG_DEPS)
    list(APPEND needs ${OSTEON_NEEDS_${dep}})
  endforeach()
  list(REMOVE_DUPLICATES needs)
  set(OSTEON_NEEDS_${name} ${needs} PARENT_SCOPE)
endfunction()

# Links the modules named, and those that they need, before the target's own objects. The linker keeps
# the first copy of a template's code, and what lies around the modules is compiled with less
# optimisation: without this the modules would run on its copies.
function(osteon_modules_first target)
  set(modules "")
  foreach(module IN LISTS ARGN)
    list(APPEND modules ${OSTEON_NEEDS_${module}})
  endforeach()
  list(REMOVE_DUPLICATES modules)
  list(REMOVE_ITEM modules ${OSTEON_LIGHT_MODULES})
  foreach(module IN LISTS modules)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:osteon_${module}>)
  endforeach()
endfunction()

# Puts a package's headers where their warnings do not stop the build.
function(osteon_link_system target)
  foreach(lib IN LISTS ARGN)
    target_link_libraries(${target} PRIVATE ${lib})
    get_target_property(dirs ${lib} INTERFACE_INCLUDE_DIRECTORIES)
    if(dirs)
      target_include_directories(${target} SYSTEM PRIVATE ${dirs})
    endif()
  endforeach()
endfunction()
