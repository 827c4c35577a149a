// SPDX-License-Identifier: MIT
#include "verdigris/files/safetensors.h"

#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/input_file.h"
#include "verdigris/files/safetensors_header.h"

namespace verdigris {
namespace {

// Values are copied as they lie in the file.
static_assert(std::endian::native == std::endian::little);

template <class Stored, class Convert>
std::vector<float> converted(const Tensor& tensor, Convert convert) {
    std::vector<float> values(tensor.bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < values.size(); ++i) {
        Stored stored;
        std::memcpy(&stored, tensor.bytes.data() + i * sizeof(Stored), sizeof(Stored));
        values[i] = convert(stored);
    }
    return values;
}

void require(bool condition, const std::string& what, const Tensor& tensor) {
    if (!condition) {
        throw std::invalid_argument("safetensors: the tensor " + quoted_name(tensor.name) + " " +
                                    what);
    }
}

void require_consistent(const Tensor& tensor) {
    require(tensor.shape.size() <= kSafetensorsRankLimit, "has too many dimensions", tensor);
    require(tensor_bytes(tensor.type, tensor.shape) == tensor.bytes.size(),
            "has bytes that do not fill its shape", tensor);
}

}  // namespace

const Tensor* SafetensorsFile::find(std::string_view name) const {
    const auto found = std::find_if(tensors.begin(), tensors.end(),
                                    [&](const Tensor& tensor) { return tensor.name == name; });
    return found == tensors.end() ? nullptr : &*found;
}

SafetensorsFile read_safetensors(const std::filesystem::path& path,
                                 const SafetensorsLimits& limits) {
    InputFile file(path);
    if (file.size() > limits.file_bytes) {
        file.refuse(
            fmt::format("is too large: {} bytes, the limit is {}", file.size(), limits.file_bytes));
    }
    SafetensorsHeader header = read_safetensors_header(file, limits);
    SafetensorsFile result;
    result.metadata = std::move(header.metadata);
    result.tensors.reserve(header.tensors.size());
    for (TensorEntry& entry : header.tensors) {
        Tensor& tensor = result.tensors.emplace_back();
        tensor.name = std::move(entry.name);
        tensor.type = entry.type;
        tensor.shape = std::move(entry.shape);
        tensor.bytes.resize(std::size_t(entry.end - entry.begin));
        if (file.read(tensor.bytes) < tensor.bytes.size()) {
            file.refuse("became shorter while it was read");
        }
    }
    return result;
}

std::map<std::string, std::string> read_safetensors_metadata(const std::filesystem::path& path,
                                                             const SafetensorsLimits& limits) {
    InputFile file(path);
    return read_safetensors_header(file, limits).metadata;
}

void write_safetensors(const std::filesystem::path& path, const SafetensorsFile& file) {
    const SafetensorsLimits limits;
    if (file.tensors.size() > limits.tensors || file.metadata.size() > limits.metadata_entries) {
        throw std::invalid_argument("safetensors: more tensors or metadata than can be read");
    }
    std::set<std::string_view> names{kSafetensorsMetadataKey};
    std::vector<const Tensor*> order;
    for (const Tensor& tensor : file.tensors) {
        require_consistent(tensor);
        require(names.insert(tensor.name).second, "has the name of another or of the metadata",
                tensor);
        order.push_back(&tensor);
    }
    // Wide types first: all are aligned, because the header is a multiple of the widest.
    std::sort(order.begin(), order.end(), [](const Tensor* a, const Tensor* b) {
        return std::tie(b->type, a->name) < std::tie(a->type, b->name);
    });
    SafetensorsHeader header;
    header.metadata = file.metadata;
    std::uint64_t end = 0;
    for (const Tensor* tensor : order) {
        const std::uint64_t begin = std::exchange(end, end + tensor->bytes.size());
        header.tensors.push_back({tensor->name, tensor->type, tensor->shape, begin, end});
    }
    const std::string start = safetensors_header(header);
    AtomicFile target(path);
    target.write(start);
    for (const Tensor* tensor : order) target.write(tensor->bytes);
    target.commit();
}

std::vector<float> floats(const Tensor& tensor, const std::string& where) {
    require_consistent(tensor);
    switch (tensor.type) {
        case TensorType::f16:
            return converted<std::uint16_t>(tensor, [](std::uint16_t bits) {
                half value;
                value.setBits(bits);
                return float(value);
            });
        case TensorType::bf16:
            return converted<std::uint16_t>(tensor, [](std::uint16_t bits) {
                return std::bit_cast<float>(std::uint32_t(bits) << 16);
            });
        case TensorType::f32:
            return converted<float>(tensor, [](float value) { return value; });
        case TensorType::f64:
            return converted<double>(tensor, [](double value) { return float(value); });
        default:
            throw Error(ErrorCode::bad_input,
                        "the tensor " + quoted_name(tensor.name) + " holds " +
                            std::string(to_string(tensor.type)) +
                            " values where F16, BF16, F32 or F64 is expected",
                        where);
    }
}

Tensor float_tensor(std::string name, std::vector<std::int64_t> shape,
                    std::span<const float> values) {
    const auto bytes = std::as_bytes(values);
    Tensor tensor{std::move(name), TensorType::f32, std::move(shape), {bytes.begin(), bytes.end()}};
    require_consistent(tensor);
    return tensor;
}

}  // namespace verdigris
