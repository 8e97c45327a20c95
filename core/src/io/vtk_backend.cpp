// The table of the backend libdsc_vtk.so.
#include "io/vtk_backend.hpp"

#include <dsc/base/backend.hpp>

#include "io/vtk_codecs.hpp"

extern "C" DSC_BACKEND_EXPORT const void* dsc_backend_vtk() {
    using namespace dsc::io;
    static constexpr VtkBackend table{decode_vtu, encode_vtu, decode_vtp, encode_vtp};
    return &table;
}
