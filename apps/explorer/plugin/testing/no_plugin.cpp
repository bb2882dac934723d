// A shared library of somebody else's.
extern "C" __attribute__((visibility("default"))) int addNumbers(int a, int b);
int addNumbers(int a, int b) { return a + b; }
