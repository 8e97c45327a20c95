# cmake -DFOLDER=... [-DMORE=FILE|FILE...] -DHEADER=x.hpp -DNAMESPACE=dsc::app -DFUNCTION=f -DOUTPUT=file.cpp -P dsc_embed.cmake
#
# Writes a source with the files below FOLDER, and those of MORE by their names alone, as text: the function FUNCTION, which
# HEADER declares, returns a span of dsc::EmbeddedFile.
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
list(SORT files)
string(REPLACE "|" ";" more "${MORE}")
set(entries "")
foreach(name IN LISTS files more)
  set(file ${FOLDER}/${name})
  if(IS_ABSOLUTE ${name})
    set(file ${name})
    get_filename_component(name ${file} NAME)
  endif()
  file(READ ${file} text)
  string(FIND "${text}" ")dsc_text\"" at)
  if(NOT at EQUAL -1)
    message(FATAL_ERROR "${file} holds the mark )dsc_text\" that ends a text; write it in another way")
  endif()
  string(APPEND entries "    {\"${name}\", R\"dsc_text(${text})dsc_text\"sv},\n")
endforeach()
file(WRITE ${OUTPUT} "// Written by share/cmake/dsc_embed.cmake.
#include \"${HEADER}\"

namespace ${NAMESPACE} {
namespace {
using namespace std::literals;  // a long text has its length without counting
constexpr dsc::EmbeddedFile files[] = {
${entries}};
}  // namespace

std::span<const dsc::EmbeddedFile> ${FUNCTION}() { return files; }

}  // namespace ${NAMESPACE}
")
