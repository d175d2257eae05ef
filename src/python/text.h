// Text between Python and C++: std::string holds the bytes of a str as os.fsencode gives them, so that names
// of files need not be UTF-8. It takes the place of nanobind/stl/string.h, which refuses such names.
#pragma once

#include <string>

#include <nanobind/nanobind.h>

namespace nanobind::detail {

template <>
struct type_caster<std::string> {
    NB_TYPE_CASTER(std::string, const_name("str"))

    bool from_python(handle source, uint32_t /*flags*/, cleanup_list* /*cleanup*/) noexcept {
        if (!PyUnicode_Check(source.ptr()))
            return false;
        const object bytes = steal(PyUnicode_AsEncodedString(source.ptr(), "utf-8", kBytesThatAreNotText));
        if (!bytes.is_valid()) { // half of a surrogate pair that stands for no byte
            PyErr_Clear();
            return false;
        }
        char* first = nullptr;
        Py_ssize_t size = 0;
        PyBytes_AsStringAndSize(bytes.ptr(), &first, &size);
        value.assign(first, static_cast<size_t>(size));
        return true;
    }

    static handle from_cpp(const std::string& value, rv_policy /*policy*/,
                           cleanup_list* /*cleanup*/) noexcept {
        return PyUnicode_DecodeUTF8(value.data(), static_cast<Py_ssize_t>(value.size()),
                                    kBytesThatAreNotText);
    }

  private:
    static constexpr const char* kBytesThatAreNotText = "surrogateescape"; // PEP 383
};

} // namespace nanobind::detail
