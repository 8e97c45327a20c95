#pragma once
// Where a value came from: a file with line and column, an override of the command line, or code.

#include <memory>
#include <string>
#include <string_view>

namespace dsc::config {

/// A text that nodes refer to. They keep it alive so that a message can show the line.
struct SourceText {
    enum class Kind { file, command_line };
    Kind kind = Kind::file;
    std::string name;  ///< the file name as the user wrote it, or "command line"
    std::string text;  ///< complete content, UTF-8; for the command line the override itself

    /// Line `number` (1-based) without its end; empty after the last line.
    std::string_view line(int number) const;
};

/// A place in a text. Line and column are 1-based and count characters, not bytes; 0 means unknown.
struct SourcePosition {
    std::shared_ptr<const SourceText> source;  ///< empty for a value made by code
    int line = 0;
    int column = 0;
    int length = 0;  ///< number of characters to underline, at least 1 if the position is known

    /// False for a value made by code (a default, a configuration built in a program).
    bool known() const noexcept { return source != nullptr; }
    /// True for a value given on the command line.
    bool from_command_line() const noexcept;
    /// "FILE:LINE:COLUMN", "command line: 'a.b=1'", or "built in" for a value made by code.
    std::string describe() const;
};

}  // namespace dsc::config
