#pragma once
// The readers that are given hostile input, each under the name that the fuzzer and the replay know
// it by.

#include <span>
#include <string>
#include <string_view>

namespace dsc::fuzz {

/// One reader of the project.
struct Reader {
    std::string_view name;  ///< also the folder of its corpus: "cloud_ply"
    void (*read)(std::string_view bytes);
};

/// All readers.
std::span<const Reader> readers();

/// The reader of this name; null without one.
const Reader* find_reader(std::string_view name);

/// Reads the bytes. A reader may return or refuse its input with an error that names the user's
/// file. Throws std::logic_error for all else: a result that contradicts itself, an error that is
/// "internal", an exception of another type.
void require_orderly(const Reader& reader, std::string_view bytes);

}  // namespace dsc::fuzz
