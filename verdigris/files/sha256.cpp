// SPDX-License-Identifier: MIT
#include "verdigris/files/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "verdigris/files/input_file.h"

namespace verdigris {

struct Sha256::State {
    EVP_MD_CTX* context = EVP_MD_CTX_new();
    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { EVP_MD_CTX_free(context); }
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
    if (!state_->context || EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) != 1) {
        throw Error(ErrorCode::failed, "the SHA-256 of the system's libcrypto cannot be used");
    }
}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::update(std::span<const std::byte> bytes) {
    if (EVP_DigestUpdate(state_->context, bytes.data(), bytes.size()) != 1) {
        throw std::logic_error("Sha256::update after hex");
    }
}

void Sha256::update(std::string_view text) {
    update(std::as_bytes(std::span(text.data(), text.size())));
}

std::string Sha256::hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned length = 0;
    if (EVP_DigestFinal_ex(state_->context, digest.data(), &length) != 1) {
        throw std::logic_error("Sha256::hex twice");
    }
    static constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (unsigned i = 0; i < length; ++i) {
        text += kDigits[digest[i] >> 4];
        text += kDigits[digest[i] & 15];
    }
    return text;
}

std::string sha256_of_file(const std::filesystem::path& path) {
    InputFile file(path);
    Sha256 hash;
    std::vector<std::byte> block(std::size_t(1) << 20);  // chosen: well above a disk's read size
    for (;;) {
        const std::size_t got = file.read(block);
        if (got == 0) break;
        hash.update(std::span(block).first(got));
    }
    return hash.hex();
}

}  // namespace verdigris
