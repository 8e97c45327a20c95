// The loader of scripts of this process.
#include "dsc/plugin/script_loader.hpp"

#include <utility>

#include <dsc/text/words.hpp>

namespace dsc::plugin {
namespace {

std::shared_ptr<ScriptLoader>& loader_of_process() {
    static std::shared_ptr<ScriptLoader> loader;
    return loader;
}

}  // namespace

ScriptLoader::~ScriptLoader() = default;

bool is_script(const std::filesystem::path& file) {
    return text::lower_case_extension(file) == ".py";
}

void set_script_loader(std::shared_ptr<ScriptLoader> loader) {
    loader_of_process() = std::move(loader);
}

std::shared_ptr<ScriptLoader> script_loader() { return loader_of_process(); }

}  // namespace dsc::plugin
