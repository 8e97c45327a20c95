// libFuzzer's door to a reader: dsc_fuzz --reader=NAME [libFuzzer's options] CORPUS...

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iostream>

#include <dsc/base/log.hpp>

#include "readers.hpp"

namespace {

const dsc::fuzz::Reader* chosen = nullptr;

constexpr std::string_view option = "--reader=";

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    for (int i = 1; i < *argc; ++i) {
        const std::string_view argument = (*argv)[i];
        if (argument.substr(0, option.size()) == option)
            chosen = dsc::fuzz::find_reader(argument.substr(option.size()));
    }
    if (chosen != nullptr) return 0;
    std::cerr << "--reader=NAME is one of";
    for (const dsc::fuzz::Reader& reader : dsc::fuzz::readers()) std::cerr << ' ' << reader.name;
    std::cerr << '\n';
    std::exit(2);
}

/// An exception that leaves this function is a crash for libFuzzer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    dsc::fuzz::require_orderly(*chosen,
                               std::string_view(reinterpret_cast<const char*>(data), size));
    return 0;
}
