# Compiler flags that every target of ours shares, and radfarm_module(), the only way to declare a module.

option(RADFARM_CHECKS "keep RADFARM_DCHECK assertions in" OFF)
set(RADFARM_SANITIZE "" CACHE STRING "comma-separated list for -fsanitize")
set(RADFARM_MARCH "x86-64-v3" CACHE STRING "instruction set on x86-64; images are equal bit for bit within one")

add_library(radfarm_flags INTERFACE)
# g++ 12 reports -Wrestrict on std::string + literal at -O3, wrongly (GCC bug 105329).
target_compile_options(radfarm_flags INTERFACE -Wall -Wextra -Wconversion -Wshadow -Werror -Wno-restrict -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  target_compile_options(radfarm_flags INTERFACE -march=${RADFARM_MARCH})
endif()
if(RADFARM_CHECKS)
  target_compile_definitions(radfarm_flags INTERFACE RADFARM_CHECKS=1)
endif()
if(RADFARM_SANITIZE)
  target_compile_options(radfarm_flags INTERFACE -fsanitize=${RADFARM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(radfarm_flags INTERFACE -fsanitize=${RADFARM_SANITIZE})
endif()
find_program(RADFARM_MOLD mold)
if(RADFARM_MOLD AND NOT RADFARM_SANITIZE)
  target_link_options(radfarm_flags INTERFACE -fuse-ld=mold)
endif()

# radfarm_module(NAME name [DEPS module...] [LINK target...] [PUBLIC_LINK target...] HEADERS h... [SOURCES c...])
#
# One folder is one module is one library, radfarm::<name>. Every module named in DEPS must already exist, so the order of
# the calls *is* the floor plan and a cycle cannot be written down. LINK names third-party targets that stay in our .cpp
# files, PUBLIC_LINK those that our headers show. tests/lint/floors.py checks the includes against DEPS.
function(radfarm_module)
  cmake_parse_arguments(PARSE_ARGV 0 m "" "NAME" "DEPS;LINK;PUBLIC_LINK;HEADERS;SOURCES")
  foreach(dep IN LISTS m_DEPS)
    if(NOT TARGET radfarm::${dep})
      message(FATAL_ERROR "module '${m_NAME}' includes '${dep}', which is not below it")
    endif()
  endforeach()
  if(m_SOURCES)
    set(scope PUBLIC)
    add_library(radfarm_${m_NAME} STATIC ${m_SOURCES})
    target_link_libraries(radfarm_${m_NAME} PRIVATE radfarm_flags ${m_LINK})
  else()
    set(scope INTERFACE)
    add_library(radfarm_${m_NAME} INTERFACE)
  endif()
  add_library(radfarm::${m_NAME} ALIAS radfarm_${m_NAME})
  target_include_directories(radfarm_${m_NAME} ${scope} ${PROJECT_SOURCE_DIR}/common)
  list(TRANSFORM m_DEPS PREPEND radfarm::)
  target_link_libraries(radfarm_${m_NAME} ${scope} ${m_DEPS} ${m_PUBLIC_LINK})
endfunction()
