# cmake -DFOLDER=... -DOUTPUT=file.cpp -P dsc_embed.cmake
#
# Writes a source with the files below FOLDER as text, for core/app/plugin_templates.hpp.
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
list(SORT files)
set(entries "")
foreach(name IN LISTS files)
  file(READ ${FOLDER}/${name} text)
  string(FIND "${text}" ")dsc_text\"" at)
  if(NOT at EQUAL -1)
    message(FATAL_ERROR "${FOLDER}/${name} holds the mark )dsc_text\" that ends a text; write it in another way")
  endif()
  string(APPEND entries "    {\"${name}\", R\"dsc_text(${text})dsc_text\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Written by share/cmake/dsc_embed.cmake.
#include \"plugin_templates.hpp\"

namespace dsc::app {
namespace {
constexpr TemplateFile files[] = {
${entries}};
}  // namespace

std::span<const TemplateFile> plugin_templates() { return files; }

}  // namespace dsc::app
")
