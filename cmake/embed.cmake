# cmake -DINPUT=FILE -DOUTPUT=FILE.cpp -DNAME=function -P embed.cmake
# Writes a C++ file in which undine::NAME() returns the text of INPUT. The text is cut, since compilers limit literals.
file(READ ${INPUT} text)
string(LENGTH "${text}" length)
set(literals "")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 8000 part)
  string(APPEND literals "\nR\"undine_text(${part})undine_text\"")
  math(EXPR at "${at} + 8000")
endwhile()
file(WRITE ${OUTPUT} "// Made from ${INPUT} by embed.cmake.
#include <string_view>

namespace undine {
std::string_view ${NAME}();
std::string_view ${NAME}() {
  static constexpr char text[] = ${literals};
  return {text, sizeof text - 1};
}
}  // namespace undine
")
