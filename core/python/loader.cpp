// Runs a Python file and registers its strategies.
#include "loader.hpp"

#include <memory>

#include <pybind11/pybind11.h>

#include <dsc/base/error.hpp>
#include <dsc/plugin/script_loader.hpp>

#include "declaration.hpp"
#include "errors.hpp"

namespace dsc::python {
namespace {

class PythonLoader final : public plugin::ScriptLoader {
public:
    plugin::PluginInfo load(const std::filesystem::path& file,
                            plugin::Registrar& registrar) override {
        const py::gil_scoped_acquire held;
        try {
            const py::object loaded =
                py::module_::import("dsc._strategies").attr("load_file")(file.string());
            for (plugin::StrategyRecord& record : records_of(loaded.attr("classes")))
                registrar.add(std::move(record));
            return info_of(loaded.attr("about"));
        } catch (py::error_already_set& error) {
            if (error.matches(PyExc_KeyboardInterrupt)) rethrow_from_python(error);
            throw PluginError("plugin.script", file.string(),
                              "does not run as a Python file: " + text_of(error),
                              "correct the file");
        } catch (const Error& error) {
            throw PluginError(error.code(), file.string(), error.what(), "correct the file");
        }
    }
};

}  // namespace

void register_loader() { plugin::set_script_loader(std::make_shared<PythonLoader>()); }

}  // namespace dsc::python
