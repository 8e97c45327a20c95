#pragma once
// Files that share/cmake/dsc_embed.cmake makes part of a program or library: an installation may be moved anywhere.

#include <string_view>

namespace dsc {

/// One of them.
struct EmbeddedFile {
    std::string_view path;  ///< "velocity/strategy.cpp"
    std::string_view text;
};

}  // namespace dsc
