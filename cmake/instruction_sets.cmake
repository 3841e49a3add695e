# Compiles files once for each instruction set, and lets nothing out of such an object but what belongs to it.
#
# A file built for AVX-512 also holds copies of inline functions (of the standard library, say) that use AVX-512. The
# linker keeps one copy of each inline function and may take that one for the whole program, which then dies on an older
# processor. So the objects of a set are joined into one in which only names with the set's namespace (core/isa.hpp) stay
# visible; all other copies are its own.

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT UNDINE_SANITIZE)
  set(UNDINE_ISA_LEVELS "2;3;4" CACHE STRING "x86-64 levels to compile the pair loops for, 2 among them; fewer compile faster")
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(UNDINE_ISA_LEVELS 2)  # what is looked for there is errors, not speed
else()
  set(UNDINE_ISA_LEVELS "")
endif()

# undine_sources_by_instruction_set(TARGET SOURCE...): the sources, compiled for each set, become part of the target.
function(undine_sources_by_instruction_set target)
  if(NOT UNDINE_ISA_LEVELS)
    target_sources(${target} PRIVATE ${ARGN})
    return()
  endif()
  foreach(level IN LISTS UNDINE_ISA_LEVELS)
    set(name ${target}_isa_v${level})
    add_library(${name} OBJECT ${ARGN})
    target_include_directories(${name} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
    target_compile_definitions(${name} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS> UNDINE_ISA=isa_v${level})
    target_compile_options(${name} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_OPTIONS> -march=x86-64-v${level}
      # Without: symbols that objcopy would leave visible. Without: moving work out of branches into registers that the
      # pair loop has not (7 % of the force pass, g++ 12). With, where there are 32 registers: ordering instructions before
      # registers are given out (6 %).
      $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique;-fno-tree-pre>
      $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:${level},4>>:-fschedule-insns;-fsched-pressure>)
    target_link_libraries(${name} PRIVATE OpenMP::OpenMP_CXX)
    if(UNDINE_SANITIZE)
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:${name}>)
      continue()
    endif()
    set(object ${CMAKE_CURRENT_BINARY_DIR}/${name}.o)
    add_custom_command(OUTPUT ${object}
      COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${object}.joined $<TARGET_OBJECTS:${name}>
      COMMAND ${CMAKE_OBJCOPY} --wildcard "--keep-global-symbol=*isa_v${level}*" ${object}.joined ${object}
      DEPENDS $<TARGET_OBJECTS:${name}> COMMAND_EXPAND_LISTS VERBATIM)
    set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
    target_sources(${target} PRIVATE ${object})
  endforeach()
endfunction()
