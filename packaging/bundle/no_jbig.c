/* libtiff wants JBIG-KIT, whose licence (GPL) does not fit what stands beside it here. Pictures in that compression are
   errors; no other picture notices. */
void jbg_dec_init(void* state) { (void)state; }
int jbg_dec_in(void* state, unsigned char* data, unsigned long length, unsigned long* used) {
    (void)state, (void)data, (void)length;
    if (used) *used = 0;
    return 64;
}
unsigned char* jbg_dec_getimage(const void* state, int plane) { return (void)state, (void)plane, (unsigned char*)0; }
long jbg_dec_getsize(const void* state) { return (void)state, 0; }
void jbg_dec_free(void* state) { (void)state; }
void jbg_enc_init(void* state) { (void)state; }
void jbg_enc_out(void* state) { (void)state; }
void jbg_enc_free(void* state) { (void)state; }
int jbg_newlen(unsigned char* data, unsigned long length) { return (void)data, (void)length, 64; }
const char* jbg_strerror(int code) { return (void)code, "this build reads no JBIG"; }
