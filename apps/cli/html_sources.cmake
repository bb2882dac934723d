# Makes html_sources.h of the page's template, style and modules: run with -D folder=, -D output=, -D modules=a.js,b.js.
# Modules become one script, each after those that it imports: import lines and the word export go away, so that every
# name at the top of a module must be its own.
function(read_text file result)
  file(READ ${file} text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(script "\n\"use strict\";\n")
string(REPLACE "," ";" modules "${modules}")
foreach(module IN LISTS modules)
  read_text(${folder}/${module} text)
  string(REGEX REPLACE "\nimport [^\n]*" "" text "\n${text}")
  string(REGEX REPLACE "\nexport " "\n" text "${text}")
  string(APPEND script "${text}")
endforeach()
read_text(${folder}/style.css style)
read_text(${folder}/page.html page)
if(script MATCHES "</script|<!--" OR style MATCHES "</style")
  message(FATAL_ERROR "${folder}: a script or style must not contain what ends or comments its element")
endif()
string(SHA256 script_sha256 "${script}")
string(SHA256 style_sha256 "${style}")

foreach(name page style script)
  set(${name} "R\"emca_page(${${name}})emca_page\"")
endforeach()

file(WRITE ${output} "#pragma once

#include <string_view>

namespace emca::cli {

inline constexpr std::string_view kPageTemplate = ${page};
inline constexpr std::string_view kPageStyle = ${style};
inline constexpr std::string_view kPageStyleSha256 = \"${style_sha256}\";
inline constexpr std::string_view kPageScript = ${script};
inline constexpr std::string_view kPageScriptSha256 = \"${script_sha256}\";

}  // namespace emca::cli
")
