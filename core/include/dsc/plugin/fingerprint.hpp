#pragma once
// The fingerprint: properties that the builds of a plugin and of its host must share, as text
// "key=value;key=value".

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#define DSC_TEXT_OF(x) #x
#define DSC_TEXT(x) DSC_TEXT_OF(x)

#if defined(__SANITIZE_ADDRESS__)
#define DSC_FINGERPRINT_SAN "address"
#elif defined(__SANITIZE_THREAD__)
#define DSC_FINGERPRINT_SAN "thread"
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define DSC_FINGERPRINT_SAN "address"
#elif __has_feature(thread_sanitizer)
#define DSC_FINGERPRINT_SAN "thread"
#endif
#endif
#ifndef DSC_FINGERPRINT_SAN
#define DSC_FINGERPRINT_SAN "none"
#endif

#ifdef _GLIBCXX_USE_CXX11_ABI
#define DSC_FINGERPRINT_CXX11ABI DSC_TEXT(_GLIBCXX_USE_CXX11_ABI)
#else
#define DSC_FINGERPRINT_CXX11ABI "none"
#endif

#ifdef _GLIBCXX_DEBUG
#define DSC_FINGERPRINT_DBGSTL "1"
#else
#define DSC_FINGERPRINT_DBGSTL "0"
#endif

#ifdef __clang__
#define DSC_FINGERPRINT_COMPILER "clang-" DSC_TEXT(__clang_major__) "." DSC_TEXT(__clang_minor__)
#else
#define DSC_FINGERPRINT_COMPILER "gcc-" DSC_TEXT(__GNUC__) "." DSC_TEXT(__GNUC_MINOR__)
#endif

#ifdef NDEBUG
#define DSC_FINGERPRINT_BUILD "release"
#else
#define DSC_FINGERPRINT_BUILD "debug"
#endif

/// Major: any change that breaks old plugins. Minor: virtual functions or fields added at the end.
#define DSC_ABI_MAJOR 8
#define DSC_ABI_MINOR 0

/// The fingerprint of the translation unit that contains it. `align` changes with -mavx, which
/// moves every Eigen member.
// clang-format off
#define DSC_FINGERPRINT                                                        \
    "abi_major=" DSC_TEXT(DSC_ABI_MAJOR)                                       \
    ";cxx11abi=" DSC_FINGERPRINT_CXX11ABI                                      \
    ";eigen=" DSC_TEXT(EIGEN_WORLD_VERSION) "." DSC_TEXT(EIGEN_MAJOR_VERSION)  \
    ";align=" DSC_TEXT(EIGEN_MAX_ALIGN_BYTES)                                  \
    ";real=f64;index=u32"                                                      \
    ";dbgstl=" DSC_FINGERPRINT_DBGSTL                                          \
    ";san=" DSC_FINGERPRINT_SAN                                                \
    ";compiler=" DSC_FINGERPRINT_COMPILER                                      \
    ";cxx=" DSC_TEXT(__cplusplus)                                              \
    ";build=" DSC_FINGERPRINT_BUILD
// clang-format on

namespace dsc::plugin {

/// The fingerprint of the core library. [parallel]
std::string_view core_fingerprint() noexcept;

/// One key with different values in two fingerprints; the value is empty on a side that lacks the
/// key.
struct FingerprintDifference {
    std::string key;
    std::string plugin;
    std::string host;
    bool hard = false;  ///< memory layouts may differ: the plugin must not be used
};

/// The keys that differ, in the order of the host's text, then the keys that only the plugin has.
/// Hard keys are abi_major, cxx11abi, eigen, align, real, index, dbgstl and san; all others are
/// soft. [parallel]
std::vector<FingerprintDifference> compare_fingerprints(std::string_view plugin,
                                                        std::string_view host);

/// An address inside the core library; it serves to find the library's file at run time. [parallel]
const void* core_address() noexcept;

}  // namespace dsc::plugin
