/** Entries of a dataset; rows of a table lie one after the other. */
export type Column = ArrayLike<number> | readonly string[] | readonly bigint[];

/** What a results file has in it. */
export interface FileContents {
  /** by group, `/` among them: texts, numbers, and counts as big numbers */
  attributes: Readonly<Record<string, Readonly<Record<string, string | number | bigint>>>>;
  /** by dataset of the reference */
  columns: Readonly<Record<string, Column>>;
}
