# Turns the page's own files into C++ text, with the SHA-256 of script and style for the content security policy.
#   cmake -DFOLDER=.. -DOUTPUT=.. -DSCRIPTS=a.js,b.js -P embed_page.cmake
file(READ ${FOLDER}/page.html page)
file(READ ${FOLDER}/page.css style)
string(REPLACE "," ";" scripts "${SCRIPTS}")
set(script "\n(() => {\n\"use strict\";\n")
foreach(name IN LISTS scripts)
  file(READ ${FOLDER}/${name} part)
  string(APPEND script "\n${part}")
endforeach()
string(APPEND script "})();\n")

foreach(name IN ITEMS style script)
  # Text that would end its element early would also break the page.
  if("${${name}}" MATCHES "</(style|script)|<!--")
    message(FATAL_ERROR "the page's ${name} holds ${CMAKE_MATCH_0}, which would end it inside HTML")
  endif()
  string(SHA256 ${name}_sha256 "${${name}}")
endforeach()

set(text "// Made from the files of viewer/page by embed_page.cmake.\n")
foreach(pair IN ITEMS page:kPage style:kStyle script:kScript)
  string(REGEX REPLACE ":.*" "" name ${pair})
  string(REGEX REPLACE ".*:" "" constant ${pair})
  string(APPEND text "constexpr std::string_view ${constant} = R\"page~(${${name}})page~\";\n")
endforeach()
string(APPEND text "constexpr std::string_view kStyleSha256 = \"${style_sha256}\";\n")
string(APPEND text "constexpr std::string_view kScriptSha256 = \"${script_sha256}\";\n")
file(WRITE ${OUTPUT} "${text}")
