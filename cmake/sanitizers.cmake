# UNDINE_SANITIZE and UNDINE_FUZZ: what they mean for undine_lib and all that links it. Such a build looks for errors; what
# counts is that it is compiled soon, for its checks make the code many times larger.
if(UNDINE_FUZZ AND NOT (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND UNDINE_SANITIZE))
  message(FATAL_ERROR "UNDINE_FUZZ needs -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DUNDINE_SANITIZE=ON")
endif()
if(NOT UNDINE_SANITIZE)
  return()
endif()

set(for_readers "")
if(UNDINE_SANITIZE STREQUAL "thread")
  set(sanitizers -fsanitize=thread)
else()
  set(for_readers -fsanitize=alignment)
  # Not asked of each address, as it takes half of the time to compile pair loops: whether it overflowed, lies in its object
  # or is null. Who follows such an address meets AddressSanitizer. Whether it is aligned is asked where bytes are read.
  set(sanitizers -fsanitize=address,undefined -fno-sanitize=pointer-overflow,object-size,null,alignment -fno-sanitize-recover=all)
  # Checks as calls, not in place: half the code.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND sanitizers --param=asan-instrumentation-with-call-threshold=0)
  else()
    list(APPEND sanitizers "SHELL:-mllvm -asan-instrumentation-with-call-threshold=0")
  endif()
endif()
target_compile_options(undine_lib PUBLIC ${sanitizers} -fno-omit-frame-pointer)
target_link_options(undine_lib PUBLIC ${sanitizers})
# Nothing is inlined by force: pair loops would take three times as long to compile.
target_compile_definitions(undine_lib PUBLIC always_inline=unused)

# Coverage, by which libFuzzer is led, of what reads files; the rest is not optimized where that takes most of the time
# to compile and little to run.
set(readers ${UNDINE_SOURCES})
list(FILTER readers INCLUDE REGEX "/(io|geometry)/|/app/(case_|setup/)")
set(plain ${UNDINE_SOURCES})
list(FILTER plain INCLUDE REGEX "/app/")
list(FILTER plain EXCLUDE REGEX "/app/(case_|setup/)")
set_source_files_properties(${plain} PROPERTIES COMPILE_OPTIONS -O0)
if(UNDINE_FUZZ)
  list(APPEND for_readers -fsanitize=fuzzer-no-link)
endif()
set_source_files_properties(${readers} PROPERTIES COMPILE_OPTIONS "${for_readers}")
