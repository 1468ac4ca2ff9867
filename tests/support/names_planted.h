// Names that names_test.sh must find, beside one that it must not.
#define PLANTED_MACRO 1
struct planted_type {
    int vndf_member;
};
static const int planted_variable = PLANTED_MACRO;
static inline int planted_function() {
    int near = planted_variable, minor(near), planted_Capital = minor;  // windows.h, sys/sysmacros.h
    return planted_Capital;
}
static inline int vndf_allowed() {
    return planted_function();
}
