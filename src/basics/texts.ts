// Texts in the languages of this package.

/** Languages of the texts. */
export type Language = 'en-US' | 'ja' | 'zh-CN' | 'zh-TW'

/** The languages, in the order of {@link Texts}. */
export const languages: readonly Language[] = ['en-US', 'ja', 'zh-CN', 'zh-TW']

/** One text in every language: whole sentences, so that they can stand side by side. */
export type Texts = readonly [enUS: string, ja: string, zhCN: string, zhTW: string]
