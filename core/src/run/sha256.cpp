// SHA-256 with OpenSSL.
#include "dsc/run/sha256.hpp"

#include <array>
#include <memory>

#include <openssl/evp.h>

#include <dsc/base/error.hpp>

namespace dsc::run {

std::string sha256(std::string_view bytes) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
        throw Error(ExitCode::internal, "run.sha256", "OpenSSL",
                    "the library of this system provides no SHA-256", "install a complete OpenSSL");
    }
    static constexpr std::string_view hex = "0123456789abcdef";
    std::string text;
    text.reserve(2 * size);
    for (unsigned i = 0; i < size; ++i) {
        text += hex[digest[i] >> 4U];
        text += hex[digest[i] & 15U];
    }
    return text;
}

}  // namespace dsc::run
