/* A library that is no backend. */
int no_backend_value(void);
int no_backend_value(void) { return 0; }
