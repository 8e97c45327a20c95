#pragma once
// Files that share/cmake/dsc_embed.cmake compiles into a program or library, so that an
// installation can be moved.

#include <string_view>

namespace dsc {

/// One embedded file.
struct EmbeddedFile {
    std::string_view path;  ///< "velocity/strategy.cpp"
    std::string_view text;
};

}  // namespace dsc
