//! The files of each code in `driver/messages`: its page, and its words.
//!
//! ```text
//! 106    messages/NC0106/page.md    messages/NC0106/en.ftl
//! ```

/// The files of a code.
#[derive(Clone, Copy, Debug)]
pub struct Files {
    /// The number of the code: 106 is `NC0106`.
    pub code: u16,
    /// What `ncc explain` shows.
    pub page: &'static str,
    /// Its entries, in the form of Fluent.
    pub words: &'static str,
}

macro_rules! files {
    ($($code:literal)*) => {
        /// All codes that there are.
        pub const FILES: &[Files] = &[$(Files {
            code: $code,
            page: include_str!(concat!("../../../messages/NC0", stringify!($code), "/page.md")),
            words: include_str!(concat!("../../../messages/NC0", stringify!($code), "/en.ftl")),
        }),*];
    };
}

files! {
    101 102 103 104 105 106 107 108 109 110 111 112 113 114 115 120
    201 202 203 204 205 206 207 208 209 210 211 212 213 214 215 216 217 218 219 220 221 222 223 224 225 226
    227 228 229 230 231 232 233 234 235 236 237 238 240 241 242 243 244 250
    301 302 303 304 305 306 307 308 309 310 311 312 313 314 320 321 322 323 324 325 326 327 328 329 330 331 332
    336 337 338 339 340 342 343 345 346 350
    401 402 403 404 405 406 407 408 409 410 411 412 413 414 415 416 417 418 419 420 421 422 423 424 425 426 427
    430 431 432 433 440 442 443 444 450
    501 502 503 504 505 506 507 508 509 510 520 521 522 523
    601 602 603 604 605 606 607 608 609 610
    701 702 703 704 705 706 707 708 709 710 711 712 713 714 715 716 717 718 719 720 721
    801 802 803 804 805 806 807 808 809 810 811 812 813 814 815
    901 902 903 904 905 906 907 908
}
