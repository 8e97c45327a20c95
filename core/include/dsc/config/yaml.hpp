#pragma once
// Conversion between YAML and ConfigNode. Only the sources of this header use the YAML library.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <dsc/config/node.hpp>

namespace dsc::config {

/// Looks up an environment variable; empty if it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// The environment of this process.
std::optional<std::string> process_environment(const std::string& name);

/// Limits against hostile input, and the source of variables.
struct YamlOptions {
    Environment environment = process_environment;
    std::size_t max_bytes = std::size_t{1} << 20;  ///< of one file
    std::size_t max_nodes = 100000;                ///< of all files, with aliases expanded
    std::size_t max_depth = 64;                    ///< of nested lists and maps
    std::size_t max_include_depth = 16;
    std::size_t max_files = 100;  ///< included files; a file included twice counts twice
};

/// Reads a file and what it includes.
///
/// Differences from plain YAML: numbers and booleans are written as in JSON (`0123`, `0x10`, `.5`,
/// `yes` are strings; `.inf`,
/// `.nan` are errors). A duplicate key, a merge key `<<`, a tag and a second document are errors.
/// `${NAME}` in a string is replaced by the environment variable; `$${` gives a literal `${`. A
/// top-level `include:` names a file or a list of files relative to the including file: maps are
/// merged deeply, lists are replaced, later files win, the including file is last. If two merged
/// maps name different strategies (`type`), the later map replaces the earlier one completely,
/// because the parameters belong to different strategies.
///
/// Throws IoError "io.open" for an unreadable file; for everything else ConfigError with position,
/// line and caret. [setup]
ConfigNode load_yaml(const std::filesystem::path& file, const YamlOptions& options = {});

/// The same for a text. Messages use `name` as the file name, and includes are relative to its
/// folder. [setup]
ConfigNode parse_yaml(std::string_view text, const std::string& name,
                      const YamlOptions& options = {});

/// One value as written to the right of `key=`: a scalar, or a flow list or map on one line.
/// Positions name `source`. Used by overrides. Throws ConfigError. [setup]
ConfigNode parse_value(const std::shared_ptr<const SourceText>& source, std::size_t begin,
                       const YamlOptions& options = {});

/// Merges `later` over `earlier` by the rules of include. [setup]
ConfigNode merge(const ConfigNode& earlier, const ConfigNode& later);

/// Writes a tree as YAML that reads back as an equal tree: block style, indentation of two blanks,
/// strings quoted if necessary, real numbers in the shortest form that reads back to the same
/// double. Ends with a newline. Throws ConfigError "config.range" for a number that is not finite.
/// [setup]
std::string to_yaml(const ConfigNode& node);

/// Shortest text that reads back as the same double and never as an integer: "0.1", "1.0",
/// "0.0003".
std::string real_text(double value);

}  // namespace dsc::config
