// Names that names_test.sh must find, beside one that it must not.
#define PLANTED_MACRO 1
struct planted_type {
    int vndf_member;
};
static const int planted_variable = PLANTED_MACRO;
static inline int planted_function() {
    return planted_variable;
}
static inline int vndf_allowed() {
    return planted_function();
}
