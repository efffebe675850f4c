/** Put in when the page is built, from docs/reference/norms.md. */
declare const HOLDFAST_NORM_SOURCES: Record<string, string>;

/** Where the numbers of each norm are from. */
export const NORM_SOURCES: Readonly<Record<string, string>> = HOLDFAST_NORM_SOURCES;
