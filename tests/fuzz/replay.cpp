// Gives a reader every file of some folders, as a fuzzer once did. Exits 1 at the first file that
// is not read or refused in order.
//
//   dsc_fuzz_replay READER FOLDER...

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "readers.hpp"

int main(int argc, char** argv) {
    const dsc::fuzz::Reader* reader = argc > 2 ? dsc::fuzz::find_reader(argv[1]) : nullptr;
    if (reader == nullptr) {
        std::cerr << "dsc_fuzz_replay READER FOLDER...; readers:\n";
        for (const dsc::fuzz::Reader& known : dsc::fuzz::readers())
            std::cerr << "  " << known.name << '\n';
        return 2;
    }
    std::vector<std::filesystem::path> files;
    for (int i = 2; i < argc; ++i)
        files.insert(files.end(), std::filesystem::directory_iterator(argv[i]), {});
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) {
        std::ifstream in(file, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), {}};
        try {
            dsc::fuzz::require_orderly(*reader, bytes);
        } catch (const std::exception& error) {
            std::cerr << file.string() << ": " << error.what() << '\n';
            return 1;
        }
    }
    std::cout << files.size() << " files\n";
    return files.empty() ? 1 : 0;
}
