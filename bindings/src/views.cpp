#include "views.hpp"

#include <unordered_map>

namespace octafield::bindings {

namespace {

struct Keeper {
    const void* address;  // null once the array is retired
    py::object owner;
    std::shared_ptr<void> retired;
};

// Capsules of the arrays with live views, by address. Used under the GIL only; never destroyed, for views may outlive
// it at exit.
std::unordered_map<const void*, PyObject*>& live_keepers() {
    static auto* const keepers = new std::unordered_map<const void*, PyObject*>;
    return *keepers;
}

void drop_keeper(void* pointer) {
    const std::unique_ptr<Keeper> keeper(static_cast<Keeper*>(pointer));
    if (keeper->address) live_keepers().erase(keeper->address);
}

}  // namespace

py::capsule keeper_of(const void* address, py::handle owner) {
    const auto found = live_keepers().find(address);
    if (found != live_keepers().end()) return py::reinterpret_borrow<py::capsule>(found->second);
    auto keeper = std::make_unique<Keeper>(Keeper{address, py::reinterpret_borrow<py::object>(owner), nullptr});
    const py::capsule capsule(keeper.get(), drop_keeper);
    keeper.release();
    live_keepers().emplace(address, capsule.ptr());
    return capsule;
}

bool has_views(const void* address) { return live_keepers().contains(address); }

void retire(const void* address, std::shared_ptr<void> retired) {
    const auto found = live_keepers().find(address);
    auto* const keeper = py::reinterpret_borrow<py::capsule>(found->second).get_pointer<Keeper>();
    live_keepers().erase(found);
    keeper->address = nullptr;
    keeper->retired = std::move(retired);
    keeper->owner = py::object();
}

}  // namespace octafield::bindings
