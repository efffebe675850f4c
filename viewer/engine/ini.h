/* inih's reader, as config_reader.cpp calls it: Debian has inih as machine code only. */
#ifndef HOLDFAST_VIEWER_ENGINE_INI_H
#define HOLDFAST_VIEWER_ENGINE_INI_H

#ifdef __cplusplus
extern "C" {
#endif

typedef char* (*ini_reader)(char* buffer, int size, void* stream);
typedef int (*ini_handler)(void* user, const char* section, const char* name, const char* value);

/* Calls the handler for every line `name = value` or `name : value` that the reader gives, without white space around
 * either and without a comment after the value: one that begins with `;` behind white space. Lines of another form are
 * passed over. Lines have no comment and no section of their own, and are not indented. Returns 0. */
int ini_parse_stream(ini_reader reader, void* stream, ini_handler handler, void* user);

#ifdef __cplusplus
}
#endif

#endif /* HOLDFAST_VIEWER_ENGINE_INI_H */
