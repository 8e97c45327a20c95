// Gives a reader every file of a folder, as a fuzzer once did. Exits 1 at the first that is not read or refused in order.
//
//   dsc_fuzz_replay READER FOLDER

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "readers.hpp"

int main(int argc, char** argv) {
    const dsc::fuzz::Reader* reader = argc == 3 ? dsc::fuzz::find_reader(argv[1]) : nullptr;
    if (reader == nullptr) {
        std::cerr << "dsc_fuzz_replay READER FOLDER; readers:\n";
        for (const dsc::fuzz::Reader& known : dsc::fuzz::readers()) std::cerr << "  " << known.name << '\n';
        return 2;
    }
    std::vector<std::filesystem::path> files(std::filesystem::directory_iterator(argv[2]), {});
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
