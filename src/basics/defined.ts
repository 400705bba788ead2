type Defined<T> = { readonly [K in keyof T]?: Exclude<T[K], undefined> }

/** What was left out stays out. */
export function definedOf<T extends object>(options: T): Defined<T> {
  return Object.fromEntries(Object.entries(options).filter(([, value]) => value !== undefined)) as Defined<T>
}
