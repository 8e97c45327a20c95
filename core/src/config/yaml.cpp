// Reads a configuration with its includes.
#include "dsc/config/yaml.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <unordered_map>
#include <vector>

#include <fmt/core.h>

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>
#include <dsc/config/diagnostics.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/text/utf8.hpp>
#include <dsc/text/words.hpp>

#include "config/node_factory.hpp"
#include "config/yaml_reader.hpp"

namespace dsc::config {
namespace {

namespace fs = std::filesystem;

/// Reads a file and its includes; contains their common data.
class Loader {
public:
    explicit Loader(const YamlOptions& options)
        : options_(options), nodes_left_(options.max_nodes) {}

    ConfigNode load(std::shared_ptr<const SourceText> source, const fs::path& file) {
        const ConfigNode tree = read(std::move(source), file);
        diagnostics_.throw_if_errors();
        return NodeFactory::rooted(tree);
    }

private:
    ConfigNode read(std::shared_ptr<const SourceText> source, const fs::path& file) {
        open_files_.push_back(file);
        ConfigNode own =
            read_yaml({std::move(source), 0, &options_, &nodes_left_, &diagnostics_, false});
        const ConfigEntry* include = own.find_entry("include");
        if (include) {
            ConfigNode merged = ConfigNode::map();
            for (const ConfigNode& item : targets(*include))
                merged = merge(merged, read_included(item, file));
            own = merge(merged, own.without("include"));
        }
        open_files_.pop_back();
        return own;
    }

    std::vector<ConfigNode> targets(const ConfigEntry& include) {
        if (include.value.is_string()) return {include.value};
        const bool is_list = include.value.is_list() &&
                             std::all_of(include.value.items().begin(), include.value.items().end(),
                                         [](const ConfigNode& item) { return item.is_string(); });
        if (is_list) return include.value.items();
        diagnostics_.error("config.include", include.value.position(),
                           "'include' must be the name of a file or a list of such names");
        return {};
    }

    ConfigNode read_included(const ConfigNode& target, const fs::path& from) {
        const fs::path shown = (from.parent_path() / target.as_string()).lexically_normal();
        std::error_code unknown;
        const fs::path file = fs::weakly_canonical(shown, unknown);
        const auto same = [&](const fs::path& open) {
            std::error_code ignored;
            return fs::weakly_canonical(open, ignored) == file;
        };
        const auto first = std::find_if(open_files_.begin(), open_files_.end(), same);
        if (first != open_files_.end()) {
            std::vector<std::string> chain;
            for (auto open = first; open != open_files_.end(); ++open)
                chain.push_back(text::printable(open->string()));
            chain.push_back(text::printable(shown.string()));
            fail("config.include", target.position(), "include cycle: " + join(chain, " -> "),
                 "a file cannot include itself");
        }
        if (open_files_.size() > options_.max_include_depth) {
            fail("config.include", target.position(),
                 fmt::format("files include one another more than {} deep",
                             options_.max_include_depth));
        }
        if (++files_ > options_.max_files) {
            fail("config.include", target.position(),
                 fmt::format("more than {} files are included", options_.max_files));
        }
        std::string cause;
        auto source = read_text(shown, options_, cause);
        if (!source) {
            diagnostics_.error("config.include", target.position(),
                               "cannot include " + text::in_quotes(shown.string()) + ": " + cause,
                               "the name is relative to the including file");
            return ConfigNode::map();
        }
        return expect_map(read(std::move(source), shown), target, shown);
    }

    ConfigNode expect_map(const ConfigNode& node, const ConfigNode& target, const fs::path& file) {
        if (node.is_map()) return node;
        if (!node.is_null()) {
            diagnostics_.error("config.include", target.position(),
                               text::in_quotes(file.string()) + " contains " +
                                   std::string(type_name(node.type())) +
                                   ", not a map of keys and values");
        }
        return ConfigNode::map();
    }

public:
    [[noreturn]] static void fail_too_large(const SourcePosition& position,
                                            const YamlOptions& options) {
        fail("config.too_large", position,
             fmt::format("the configuration is larger than {} bytes", options.max_bytes));
    }

    /// nullptr and the cause if the file cannot be read. Throws ConfigError "config.too_large".
    static std::shared_ptr<const SourceText> read_text(const fs::path& file,
                                                       const YamlOptions& options,
                                                       std::string& cause) {
        std::error_code error;
        const fs::file_status status = fs::status(file, error);
        if (!fs::exists(status)) {
            cause = "the file does not exist";
            return nullptr;
        }
        if (fs::is_directory(status)) {
            cause = "it is a folder";
            return nullptr;
        }
        std::ifstream stream(file, std::ios::binary);
        // One byte more than the limit shows that a file is too large, also if the size is unknown
        // (a pipe).
        std::string text(options.max_bytes + 1, '\0');
        if (stream) stream.read(text.data(), static_cast<std::streamsize>(text.size()));
        if (!stream.is_open() || stream.bad()) {
            cause = "it cannot be read";
            return nullptr;
        }
        text.resize(static_cast<std::size_t>(stream.gcount()));
        if (text.size() > options.max_bytes)
            fail_too_large({make_source("", file.string()), 0, 0, 0}, options);
        return make_source(text, file.string());
    }

    static std::shared_ptr<const SourceText> make_source(std::string_view text,
                                                         const std::string& name) {
        return std::make_shared<const SourceText>(
            SourceText{SourceText::Kind::file, name, std::string(without_byte_order_mark(text))});
    }

private:
    const YamlOptions& options_;
    std::size_t nodes_left_;
    std::size_t files_ = 0;
    Diagnostics diagnostics_;
    std::vector<fs::path> open_files_;
};

bool names_other_strategy(const ConfigNode& earlier, const ConfigNode& later) {
    const ConfigNode* old_type = earlier.find("type");
    const ConfigNode* new_type = later.find("type");
    return old_type && new_type && *old_type != *new_type;
}

}  // namespace

std::optional<std::string> process_environment(const std::string& name) {
    const char* value = std::getenv(name.c_str());
    return value ? std::optional<std::string>(value) : std::nullopt;
}

ConfigNode load_yaml(const fs::path& file, const YamlOptions& options) {
    std::string cause;
    auto source = Loader::read_text(file, options, cause);
    if (!source) {
        throw IoError("io.open", file.string(), "", "cannot read the configuration: " + cause,
                      "name a readable YAML file");
    }
    return Loader(options).load(std::move(source), file);
}

ConfigNode parse_yaml(std::string_view text, const std::string& name, const YamlOptions& options) {
    auto source = Loader::make_source(text, name);
    if (source->text.size() > options.max_bytes) {
        Loader::fail_too_large({source, 0, 0, 0}, options);
    }
    return Loader(options).load(std::move(source), name);
}

ConfigNode parse_value(const std::shared_ptr<const SourceText>& source, std::size_t begin,
                       const YamlOptions& options) {
    Diagnostics diagnostics;
    std::size_t nodes_left = options.max_nodes;
    const ConfigNode node = read_yaml({source, begin, &options, &nodes_left, &diagnostics, true});
    diagnostics.throw_if_errors();
    return NodeFactory::rooted(node);
}

ConfigNode merge(const ConfigNode& earlier, const ConfigNode& later) {
    if (!earlier.is_map() || !later.is_map() || names_other_strategy(earlier, later)) return later;
    std::vector<ConfigEntry> entries = earlier.entries();
    std::unordered_map<std::string_view, std::size_t> index;
    for (std::size_t i = 0; i < earlier.entries().size(); ++i)
        index.emplace(earlier.entries()[i].key, i);
    for (const ConfigEntry& entry : later.entries()) {
        const auto old = index.find(entry.key);
        if (old == index.end()) {
            entries.push_back(entry);
        } else {
            ConfigEntry& target = entries[old->second];
            target = ConfigEntry(entry.key, merge(target.value, entry.value), entry.position);
        }
    }
    return NodeFactory::map(std::move(entries), later.position()).with_path(earlier.path());
}

}  // namespace dsc::config
