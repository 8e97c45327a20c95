// Reads PCD and PLY files with PCL's PCLPointCloud2, which keeps fields of type double.
#include "pcl_files.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>
#include <optional>
#include <sstream>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <dsc/base/error.hpp>
#include <dsc/base/release.hpp>
#include <dsc/text/words.hpp>

#include "attributes.hpp"
#include "formats.hpp"

namespace dsc::cloud {

namespace {

const pcl::PCLPointField* find_field(const pcl::PCLPointCloud2& blob, std::string_view name) {
    for (const pcl::PCLPointField& field : blob.fields)
        if (field.name == name) return &field;
    return nullptr;
}

template <class T>
double value_of(const std::uint8_t* data) {
    T value;
    std::memcpy(&value, data, sizeof value);
    return static_cast<double>(value);
}

using Getter = double (*)(const std::uint8_t*);

Getter getter(std::uint8_t type) {
    switch (type) {
        case pcl::PCLPointField::FLOAT64: return value_of<double>;
        case pcl::PCLPointField::FLOAT32: return value_of<float>;
        case pcl::PCLPointField::INT8: return value_of<std::int8_t>;
        case pcl::PCLPointField::UINT8: return value_of<std::uint8_t>;
        case pcl::PCLPointField::INT16: return value_of<std::int16_t>;
        case pcl::PCLPointField::UINT16: return value_of<std::uint16_t>;
        case pcl::PCLPointField::INT32: return value_of<std::int32_t>;
        case pcl::PCLPointField::UINT32: return value_of<std::uint32_t>;
        default: return nullptr;
    }
}

/// A number of every point, from one field.
struct Numbers {
    Getter get = nullptr;
    std::size_t offset = 0;
    bool whole = false;
};

/// The numbers of these fields; empty if one of them is not a single number.
template <std::size_t n>
std::optional<std::array<Numbers, n>> numbers_of(const pcl::PCLPointCloud2& blob,
                                                 const std::array<std::size_t, n>& fields) {
    std::array<Numbers, n> out;
    for (std::size_t k = 0; k < n; ++k) {
        const pcl::PCLPointField& field = blob.fields[fields[k]];
        out[k] = {getter(field.datatype), field.offset,
                  field.datatype != pcl::PCLPointField::FLOAT32 &&
                      field.datatype != pcl::PCLPointField::FLOAT64};
        if (field.count != 1 || out[k].get == nullptr) return std::nullopt;
    }
    return out;
}

/// Normals and colours of the points, taken one by one.
class Attributes {
public:
    explicit Attributes(const pcl::PCLPointCloud2& blob) {
        std::vector<std::string> names;
        for (const pcl::PCLPointField& field : blob.fields) names.push_back(field.name);
        const AttributeColumns columns = attribute_columns(names);
        if (columns.normals) normals_ = numbers_of(blob, *columns.normals);
        if (columns.colours) colours_ = numbers_of(blob, *columns.colours);
        if (columns.intensity) intensity_ = numbers_of<1>(blob, {*columns.intensity});
        if (columns.packed) {
            const pcl::PCLPointField& field = blob.fields[*columns.packed];
            if (field.count == 1 && (field.datatype == pcl::PCLPointField::FLOAT32 ||
                                     field.datatype == pcl::PCLPointField::UINT32))
                packed_ = field.offset;
        }
    }

    void take(const std::uint8_t* point, Cloud& cloud) {
        if (normals_) cloud.normals.push_back(direction_of(vector(point, *normals_)));
        if (colours_) values_.push_back(vector(point, *colours_));
        if (intensity_) greys_.push_back((*intensity_)[0].get(point + (*intensity_)[0].offset));
        if (!packed_) return;
        std::uint32_t packed = 0;
        std::memcpy(&packed, point + *packed_, sizeof packed);
        cloud.colours.push_back({static_cast<std::uint8_t>(packed >> 16U),
                                 static_cast<std::uint8_t>(packed >> 8U),
                                 static_cast<std::uint8_t>(packed)});
    }

    void finish(Cloud& cloud) const {
        if (colours_) cloud.colours = colours_from(values_, (*colours_)[0].whole);
        if (intensity_) cloud.colours = greys_from(greys_);
        keep_whole_normals(cloud);
    }

private:
    static Vec3 vector(const std::uint8_t* point, const std::array<Numbers, 3>& numbers) {
        Vec3 out;
        for (std::size_t k = 0; k < 3; ++k)
            out[static_cast<int>(k)] = numbers[k].get(point + numbers[k].offset);
        return out;
    }

    std::optional<std::array<Numbers, 3>> normals_, colours_;
    std::optional<std::array<Numbers, 1>> intensity_;
    std::optional<std::size_t> packed_;
    std::vector<Vec3> values_;
    std::vector<double> greys_;
};

[[noreturn]] void refused(const std::string& file, std::string_view format) {
    throw IoError("io.syntax", file, "",
                  "PCL's " + std::string(format) + " reader does not accept the file",
                  "save the cloud again, for instance as PLY with x, y and z only");
}

Cloud extract(const std::string& file, const pcl::PCLPointCloud2& blob, const FileCheck& check,
              ReadReport& report) {
    const std::size_t step = blob.point_step;
    if (step == 0 || blob.data.size() != check.points * step) refused(file, report.format);
    std::array<const std::uint8_t*, 3> data{};
    std::array<Getter, 3> get{};
    for (std::size_t k = 0; k < 3; ++k) {
        const pcl::PCLPointField* const field =
            find_field(blob, std::string_view("xyz").substr(k, 1));
        if (!field) refused(file, report.format);
        get[k] = getter(field->datatype);
        if (!get[k])
            throw IoError(
                "io.format", file, "",
                "field " + text::in_quotes(field->name) + " has a type that is not supported",
                "save the coordinates as float or double");
        data[k] = blob.data.data() + field->offset;
    }

    Attributes attributes(blob);
    Cloud cloud;
    cloud.points.reserve(check.points);
    for (std::size_t i = 0; i < check.points; ++i) {
        const std::size_t at = i * step;
        const Vec3 p(get[0](data[0] + at), get[1](data[1] + at), get[2](data[2] + at));
        if (!p.allFinite()) continue;
        cloud.points.push_back(p);
        attributes.take(blob.data.data() + at, cloud);
    }
    attributes.finish(cloud);
    cloud.sensor = check.sensor;
    report.dropped_non_finite = check.points - cloud.points.size();
    if (cloud.points.empty())
        throw IoError(
            "io.non_finite", file, "",
            "all " + text::counted(check.points, "point") + " have NaN or infinite coordinates",
            "save a cloud with finite coordinates");
    return cloud;
}

/// Runs a PCL reader without its output; exceptions and refusals become one IoError. `read` fills
/// the cloud and returns PCL's result.
template <class Read>
Cloud read_with(const std::string& file, const FileCheck& check, ReadReport& report, Read&& read) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    pcl::PCLPointCloud2 blob;
    int result = -1;
    try {
        result = read(blob);
    } catch (const std::exception&) {
        result = -1;
    }
    if (result < 0) refused(file, report.format);
    return extract(file, blob, check, report);
}

/// Bytes at a path that PCL can open; they stay in memory.
class MemoryFile {
public:
    MemoryFile(const std::string& file, std::string_view bytes)
        : descriptor_(::memfd_create("dsc", MFD_CLOEXEC)) {
        while (descriptor_ >= 0 && !bytes.empty()) {
            const ::ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) break;
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        if (descriptor_ >= 0 && bytes.empty()) return;
        const std::string cause = std::generic_category().message(errno);
        if (descriptor_ >= 0) ::close(descriptor_);
        throw IoError("io.memory", file, "", "no memory for its content: " + cause,
                      "free some memory");
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

/// PCL would read the number of points from some comments: they get another keyword of the same
/// length.
void hide_grid_comments(std::string& bytes, const FileCheck& check) {
    constexpr std::string_view comment = "comment ";  // as long as "obj_info"
    for (const std::size_t at : check.grid_comments) bytes.replace(at, comment.size(), comment);
}

}  // namespace

Cloud read_pcd(const std::string& file, std::string bytes, ReadReport& report,
               std::vector<std::string>& names) {
    const FileCheck check = check_pcd(file, bytes);
    report.points = check.points;
    report.format = "PCD";
    names = check.names;
    return read_with(file, check, report, [&](pcl::PCLPointCloud2& blob) {
        pcl::PCDReader reader;
        Eigen::Vector4f origin;
        Eigen::Quaternionf orientation;
        int version = 0, encoding = 0;
        unsigned place = 0;
        std::istringstream header(bytes.substr(0, check.body));
        bytes.erase(0, check.body);
        const int result =
            reader.readHeader(header, blob, origin, orientation, version, encoding, place);
        if (result < 0) return result;
        if (encoding != 0)
            return reader.readBodyBinary(reinterpret_cast<const unsigned char*>(bytes.data()), blob,
                                         version, encoding == 2, 0);
        std::istringstream text(std::move(bytes));
        return reader.readBodyASCII(text, blob, version);
    });
}

Cloud read_ply(const std::string& file, std::string bytes, ReadReport& report,
               std::vector<std::string>& names) {
    const FileCheck check = check_ply(file, bytes);
    report.points = check.points;
    report.format = "PLY";
    names = check.names;
    hide_grid_comments(bytes, check);
    const MemoryFile copy(file, bytes);
    release(bytes);  // PCL needs the memory
    return read_with(file, check, report, [&](pcl::PCLPointCloud2& blob) {
        Eigen::Vector4f origin;
        Eigen::Quaternionf orientation;
        int version = 0;
        return pcl::PLYReader().read(copy.path(), blob, origin, orientation, version, 0);
    });
}

}  // namespace dsc::cloud
