#pragma once
// Describes a strategy and its parameters for people, programs and experiments.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <dsc/config/schema.hpp>

namespace dsc::app {

struct Described {
    std::string kind;
    std::string id;
    std::string summary;
    std::string plugin;
    std::string version;
    std::string file;
    const config::Schema* schema = nullptr;
};

/// A table with one row per strategy.
std::string list_text(const std::vector<Described>& all);
nlohmann::ordered_json summary_json(const Described& described);
/// All that is declared: parameters, conditions, old names.
nlohmann::ordered_json full_json(const Described& described);
std::string description_text(const Described& described);
/// The parameters with their defaults as a commented block for an experiment.
std::string yaml_text(const Described& described);
/// A reference page in Markdown. It names no file and no version, so that it changes only with the
/// declaration.
std::string markdown_text(const Described& described);

/// The purpose of a field and, in brackets, the values that it accepts.
std::string doc_text(const config::Field& field);

/// The text in lines of about 100 characters, each after `indent`.
std::string wrapped(const std::string& text, const std::string& indent);

}  // namespace dsc::app
