// Writes a PNG.
#include <string>

#include <png.h>

#include <dsc/base/error.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/io/picture.hpp>

namespace dsc::io {

void write_png(const std::filesystem::path& file, const Image& image) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGB;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
    png_alloc_size_t size = bytes.size();
    if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0,
                                  nullptr) == 0) {
        throw IoError("io.write", file.string(), "", std::string("PNG: ") + header.message,
                      "use another size");
    }
    bytes.resize(size);
    write_file(file, bytes);
}

}  // namespace dsc::io
