// Turns the events of the YAML library into a tree with places.
#include "config/yaml_reader.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <dsc/text/utf8.hpp>
#include <dsc/text/words.hpp>

#include "config/node_factory.hpp"
#include "config/scalar.hpp"
#include "config/variables.hpp"

namespace dsc::config {
namespace {

/// Converts the library's marks (0-based, in bytes) to positions (1-based, in characters).
class Places {
public:
    Places(std::shared_ptr<const SourceText> source, std::size_t begin)
        : source_(std::move(source)), begin_(begin) {
        starts_.push_back(0);
        for (std::size_t i = 0; i < source_->text.size(); ++i) {
            if (source_->text[i] == '\n') starts_.push_back(i + 1);
        }
    }

    /// Byte of the text that a mark points to.
    std::size_t offset(const YAML::Mark& mark) const {
        const std::string& text = source_->text;
        if (mark.line < 0 || static_cast<std::size_t>(mark.line) >= starts_.size())
            return text.size();
        const auto line = static_cast<std::size_t>(mark.line);
        const std::size_t start = line == 0 ? begin_ : starts_[line];
        return std::min(start + static_cast<std::size_t>(std::max(mark.column, 0)), text.size());
    }

    SourcePosition at(std::size_t offset, std::size_t length) const {
        const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
        return {source_, static_cast<int>(next - starts_.begin()), column(*(next - 1), offset),
                static_cast<int>(std::max<std::size_t>(length, 1))};
    }
    SourcePosition at(const YAML::Mark& mark) const { return at(offset(mark), 1); }

    /// The place of a scalar: after its anchor, underlined to its end on this line.
    SourcePosition scalar(const YAML::Mark& mark, std::string_view value) const {
        const std::string_view text = source_->text;
        std::size_t begin = offset(mark);
        if (begin < text.size() && text[begin] == '&') {
            begin = std::min(text.find_first_of(" \t\r\n", begin), text.size());
            begin = std::min(text.find_first_not_of(" \t\r\n", begin), text.size());
        }
        if (begin >= text.size()) return at(begin, 1);
        const char first = text[begin];
        if (first == '|' || first == '>') return at(begin, 1);
        const auto next_line = std::upper_bound(starts_.begin(), starts_.end(), begin);
        const std::size_t line_end = next_line == starts_.end() ? text.size() : *next_line - 1;
        if (first != '"' && first != '\'') {
            const std::size_t end = std::min(begin + value.size(), line_end);
            return at(begin, text::character_count(text.substr(begin, end - begin)));
        }
        const std::size_t close = closing_quote(begin);
        if (close >= text.size()) {
            // The library accepts this if the file ends with a newline.
            fail("config.yaml", at(begin, 1),
                 "malformed YAML: the quote that starts here is not closed");
        }
        const std::size_t end = std::min(close + 1, line_end);
        return at(begin, text::character_count(text.substr(begin, end - begin)));
    }

    /// The character of the text at a position that this object made.
    char character(const SourcePosition& position) const {
        const std::string_view line = source_->line(position.line);
        const auto column = static_cast<std::size_t>(position.column - 1);
        return column < line.size() ? line[column] : '\0';
    }

private:
    /// Places come in order, so on a long line only the part between two of them is counted.
    int column(std::size_t line_start, std::size_t offset) const {
        const bool goes_on = last_.line_start == line_start && last_.offset <= offset;
        const std::size_t from = goes_on ? last_.offset : line_start;
        const int before = goes_on ? last_.column : 1;
        const std::string_view between =
            std::string_view(source_->text).substr(from, offset - from);
        last_ = {line_start, offset, before + static_cast<int>(text::character_count(between))};
        return last_.column;
    }

    /// End of the quoted scalar that starts at `begin`; the size of the text if it has no end.
    std::size_t closing_quote(std::size_t begin) const {
        const std::string_view text = source_->text;
        const char quote = text[begin];
        std::size_t at = begin + 1;
        for (; at < text.size(); ++at) {
            if (quote == '"' && text[at] == '\\') {
                ++at;
            } else if (text[at] == quote) {
                const bool doubled = quote == '\'' && at + 1 < text.size() && text[at + 1] == quote;
                if (!doubled) return at;
                ++at;
            }
        }
        return text.size();
    }

    std::shared_ptr<const SourceText> source_;
    std::size_t begin_;
    std::vector<std::size_t> starts_;

    struct Counted {
        std::size_t line_start = 0;
        std::size_t offset = 0;
        int column = 1;
    };
    mutable Counted last_;
};

/// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
public:
    explicit TreeBuilder(const ReadJob& job)
        : job_(job),
          places_(job.source, job.begin),
          root_(ConfigNode().placed({job.source, 0, 0, 0})) {}

    ConfigNode take() { return std::move(root_); }
    const Places& places() const { return places_; }
    /// After this call, a further document is an error.
    void expect_no_more() { only_document_read_ = true; }

    /// The most common cause of a syntax fault at this place.
    std::string syntax_hint(const SourcePosition& position) const {
        const std::string_view line = job_.source->line(position.line);
        const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
        if (line.substr(0, first).find('\t') != std::string_view::npos)
            return "indent with blanks, not tabs";
        const std::size_t variable = line.find("${");
        const bool has_variable = variable != std::string_view::npos;
        if (has_variable &&
            line.substr(0, variable).find_first_of("\"'") == std::string_view::npos) {
            return "put text with ${...} in quotes";
        }
        const std::size_t colon = line.find(": ");
        if (colon != std::string_view::npos &&
            line.find(": ", colon + 1) != std::string_view::npos &&
            line.find_first_of("\"'{[") == std::string_view::npos) {
            return "put text that contains ': ' in quotes";
        }
        if (frames_.empty() || !is_flow(frames_.back())) {
            // After a value on the same line as its key, nothing can be nested.
            const std::string_view before = job_.source->line(position.line - 1);
            const bool has_value =
                before.find(": ") != std::string_view::npos && before.back() != ':';
            if (has_value && first < line.size() && first > before.find_first_not_of(' '))
                return "is this line indented too far?";
        }
        for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
            if (!is_flow(*frame)) continue;
            const char bracket = places_.character(frame->position);
            const std::string line_text = " in line " + std::to_string(frame->position.line);
            return std::string("is the '") + bracket + "'" + (job_.flow_only ? "" : line_text) +
                   " closed?";
        }
        return {};
    }

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (only_document_read_) {
            fail("config.yaml", places_.at(mark), "malformed YAML: a second document starts here",
                 "a configuration is one document");
        }
    }
    void OnDocumentEnd() override {}

    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        if (expects_key()) {
            fail("config.yaml", places_.at(mark), "malformed YAML: a key is empty or null",
                 "write it in quotes");
        }
        // An empty value is marked at the next token; the place of its key is better.
        const bool in_map = !frames_.empty() && frames_.back().is_map;
        count(mark);
        finish(ConfigNode().placed(in_map ? frames_.back().key_position : places_.at(mark)), anchor,
               1);
    }

    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        if (expects_key())
            fail("config.yaml", places_.at(mark), "malformed YAML: an alias cannot be a key");
        const auto found = anchors_.find(anchor);
        if (found == anchors_.end()) {
            fail("config.yaml", places_.at(mark), "malformed YAML: an alias inside its own anchor");
        }
        count(mark, found->second.nodes);
        if (frames_.size() + found->second.depth > job_.options->max_depth) too_deep(mark);
        finish(found->second.node, 0, found->second.nodes, found->second.depth);
    }

    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& value) override {
        const SourcePosition position = places_.scalar(mark, value);
        refuse_tag(tag, position);
        const bool quoted = tag == "!";
        if (expects_key()) {
            take_key(value, quoted, position);
            return;
        }
        count(mark);
        finish(scalar_node(value, quoted, position), anchor, 1);
    }

    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value style) override {
        open(mark, tag, anchor, style, false);
    }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value style) override {
        open(mark, tag, anchor, style, true);
    }
    void OnSequenceEnd() override {
        Frame frame = std::move(frames_.back());
        frames_.pop_back();
        finish(NodeFactory::list(std::move(frame.items), frame.position), frame.anchor, frame.nodes,
               frame.depth);
    }
    void OnMapEnd() override {
        Frame frame = std::move(frames_.back());
        frames_.pop_back();
        finish(NodeFactory::map(std::move(frame.entries), frame.position), frame.anchor,
               frame.nodes, frame.depth);
    }

private:
    struct Frame {
        bool is_map = false;
        bool is_key = false;  ///< is at the place of a key; an error was already reported
        SourcePosition position;
        YAML::anchor_t anchor = 0;
        std::size_t nodes = 1;  ///< in this subtree, aliases expanded
        std::size_t depth = 1;  ///< of this subtree
        std::vector<ConfigNode> items;
        std::vector<ConfigEntry> entries;
        std::unordered_map<std::string, SourcePosition> seen;
        bool has_key = false;
        bool drop_value = false;  ///< value of a key that was refused
        std::string key;
        SourcePosition key_position;
    };
    struct Anchored {
        ConfigNode node;
        std::size_t nodes = 1;
        std::size_t depth = 0;
    };

    bool is_flow(const Frame& frame) const {
        const char bracket = places_.character(frame.position);
        return bracket == '[' || bracket == '{';
    }

    bool expects_key() const {
        return !frames_.empty() && frames_.back().is_map && !frames_.back().has_key;
    }

    void refuse_tag(const std::string& tag, const SourcePosition& position) {
        if (tag.empty() || tag == "?" || tag == "!") return;
        fail("config.yaml", position, "the YAML tag " + text::in_quotes(tag) + " is not supported",
             "write the value without a tag; quotes make a string");
    }

    void take_key(const std::string& key, bool quoted, const SourcePosition& position) {
        Frame& frame = frames_.back();
        frame.has_key = true;
        frame.key = key;
        frame.key_position = position;
        frame.drop_value = true;
        if (key == "<<" && !quoted) {
            job_.diagnostics->error("config.merge_key", position,
                                    "the merge key '<<' is not supported",
                                    "use 'include: FILE' at the top of the file");
            return;
        }
        const auto [first, fresh] = frame.seen.emplace(key, position);
        if (!fresh) {
            job_.diagnostics->error("config.duplicate_key", position,
                                    fmt::format("duplicate key {}, first given in line {}",
                                                text::in_quotes(key), first->second.line),
                                    "remove one of the two");
            return;
        }
        frame.drop_value = false;
    }

    ConfigNode scalar_node(const std::string& value, bool quoted, const SourcePosition& position) {
        ConfigNode node(value);
        if (!quoted) {
            PlainScalar plain = read_plain(value);
            if (!plain.fault.empty()) {
                job_.diagnostics->error("config.not_finite", position, plain.fault,
                                        "write a finite decimal number");
            }
            node = std::move(plain.value);
        }
        if (node.is_string()) {
            node = ConfigNode(expand_variables(node.as_string(), position,
                                               job_.options->environment, *job_.diagnostics));
        }
        return node.placed(position, quoted);
    }

    void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
              YAML::EmitterStyle::value style, bool is_map) {
        const SourcePosition position = places_.at(mark);
        refuse_tag(tag, position);
        // These two are only recorded: if the text has a syntax fault later, that message is
        // better.
        if (expects_key()) {
            job_.diagnostics->error("config.yaml", position,
                                    "malformed YAML: a list or map cannot be a key",
                                    "put text with braces or brackets in quotes");
        } else if (job_.flow_only && frames_.empty() && style == YAML::EmitterStyle::Block) {
            job_.diagnostics->error("config.yaml", position,
                                    "malformed YAML: expected a scalar, [list] or {map}",
                                    "put text with ': ' or '- ' in quotes");
        }
        count(mark);
        if (frames_.size() >= job_.options->max_depth) too_deep(mark);
        Frame frame;
        frame.is_map = is_map;
        frame.position = position;
        frame.anchor = anchor;
        frame.is_key = expects_key();
        frames_.push_back(std::move(frame));
    }

    void close(ConfigNode node, const Frame& frame) {
        if (frame.is_key) {
            frames_.back().has_key = true;
            frames_.back().drop_value = true;
            frames_.back().key_position = frame.position;
        } else {
            finish(std::move(node), frame.anchor, frame.nodes, frame.depth);
        }
    }

    void count(const YAML::Mark& mark, std::size_t nodes = 1) {
        if (nodes > *job_.nodes_left) {
            fail("config.too_large", places_.at(mark),
                 fmt::format("more than {} values, aliases expanded", job_.options->max_nodes));
        }
        *job_.nodes_left -= nodes;
    }

    [[noreturn]] void too_deep(const YAML::Mark& mark) {
        fail("config.too_deep", places_.at(mark),
             fmt::format("lists and maps are nested more than {} deep", job_.options->max_depth));
    }

    void finish(ConfigNode node, YAML::anchor_t anchor, std::size_t nodes, std::size_t depth = 0) {
        if (anchor != 0) anchors_[anchor] = Anchored{node, nodes, depth};
        if (frames_.empty()) {
            root_ = std::move(node);
            return;
        }
        Frame& frame = frames_.back();
        frame.nodes += nodes;
        frame.depth = std::max(frame.depth, depth + 1);
        if (!frame.is_map) {
            frame.items.push_back(std::move(node));
            return;
        }
        frame.has_key = false;
        if (!frame.drop_value)
            frame.entries.emplace_back(frame.key, std::move(node), frame.key_position);
    }

    const ReadJob& job_;
    Places places_;
    std::vector<Frame> frames_;
    // used for look-ups only; never iterated
    std::unordered_map<YAML::anchor_t, Anchored> anchors_;
    ConfigNode root_;
    bool only_document_read_ = false;
};

void refuse_non_text(const ReadJob& job, const Places& places) {
    const std::string& text = job.source->text;
    const auto bad = text::first_non_text(std::string_view(text).substr(job.begin));
    if (!bad) return;
    const std::size_t offset = job.begin + *bad;
    constexpr const char* digits = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(text[offset]);
    fail("config.yaml", places.at(offset, 1),
         std::string("malformed YAML: the byte 0x") + digits[byte >> 4U] + digits[byte & 15U] +
             " is not text",
         "a configuration must be a text file in UTF-8");
}

}  // namespace

ConfigNode read_yaml(const ReadJob& job) {
    TreeBuilder builder(job);
    refuse_non_text(job, builder.places());
    std::istringstream stream(job.source->text.substr(job.begin));
    try {
        YAML::Parser parser(stream);
        parser.HandleNextDocument(builder);
        builder.expect_no_more();
        parser.HandleNextDocument(builder);
    } catch (const YAML::Exception& error) {
        const SourcePosition position = builder.places().at(error.mark);
        fail("config.yaml", position, "malformed YAML: " + text::printable(error.msg),
             builder.syntax_hint(position));
    }
    return builder.take();
}

}  // namespace dsc::config
